// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/interface.hpp"

#include <cmath>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>

#include "app/option_table.hpp"
#include "engine/core/text/text.hpp"

namespace extremal::app {
namespace {

constexpr const char* sceneHelp = "a path, preset:NAME, or - for standard input";

/// A finite number from `least` to `most`.
CLI::Validator numberIn(double least, double most) {
    return {[=](std::string& text) {
                const auto number = parseNumber(text);
                if (number && std::isfinite(*number) && *number >= least && *number <= most)
                    return std::string();
                const bool isBounded = std::isfinite(least) && std::isfinite(most);
                return "must be a finite number" +
                       (isBounded ? " from " + formatNumber(least) + " to " + formatNumber(most) : "") +
                       ", got \"" + text + "\"";
            },
            ""};
}
void addSnapshot(CLI::App& app, Arguments& arguments) {
    SnapshotOptions& snapshot = arguments.snapshot;
    CLI::App& verb =
        addVerb(app, arguments, "snapshot", "draw the contents of the window, without a display", true);
    verb.add_option("--out", snapshot.out, "the picture: .png, .pdf or .svg")->required()->type_name("FILE");
    verb.add_option("--size", snapshot.size, "pixels, sides 64 to 8192; 1200x800 by default")
        ->type_name("WxH");
    verb.add_option("--view", snapshot.view, "one view (extremal list views), or all")->type_name("NAME");
    CLI::Option* time =
        verb.add_option("--time", snapshot.time, "by default that of the scene (\"show\"), or the end")
            ->type_name("T")
            ->check(finiteNumber());
    CLI::Option* compare = verb.add_option("--compare", snapshot.compareWith,
                                           "exit 1 if the picture differs, and write FILE.diff.png")
                               ->type_name("BASE.png");
    verb.add_option("--tolerance", snapshot.tolerance,
                    "percent of the pixels that may differ, of any tile 50 times as many")
        ->type_name("PERCENT")
        ->needs(compare)
        ->check(numberIn(0, 100));
    addCommon(verb, arguments.common);
    verb.final_callback([&snapshot, time] { snapshot.hasTime = time->count() > 0; });
}

/// Its words are checked by app/figure.cpp, against the tables of ui/pictures/paper_figure.hpp.
void addFigure(CLI::App& app, Arguments& arguments) {
    FigureOptions& figure = arguments.figure;
    CLI::App& verb = addVerb(app, arguments, "figure",
                             "a figure for a paper: panels, one legend, data and caption beside it", true);
    const auto repeatable = [](CLI::Option* option) {
        option->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    };
    verb.add_option("--out", figure.out, "the figure: .pdf, .svg or .png; beside it .csv and .tex")
        ->required()
        ->type_name("FILE");
    repeatable(
        verb.add_option("--view", figure.views, "a panel; repeatable, by default the plots of the scene")
            ->type_name("NAME"));
    repeatable(
        verb.add_option("--only", figure.only, "the label of a scheme; repeatable")->type_name("LABEL"));
    verb.add_option("--width", figure.width, "column (86, the default), page (178), slide (254), or a number")
        ->type_name("MM");
    verb.add_option("--ratio", figure.ratio, "height of a panel over its width, 0.7 by default")
        ->type_name("R");
    verb.add_option("--letters", figure.letters, "size of the letters at the ticks in points, 8 by default")
        ->type_name("PT");
    verb.add_option("--lines", figure.lines, "width of the curves in points, 0.75 by default")
        ->type_name("PT");
    verb.add_option("--columns", figure.columns, "panels beside each other; 0, the default: as have room")
        ->type_name("N");
    verb.add_option("--dpi", figure.dotsPerInch, "dots per inch of a PNG, 300 by default")->type_name("N");
    verb.add_option("--font", figure.font, "a font of this machine, or the file of one; Inter by default")
        ->type_name("NAME");
    verb.add_option("--legend", figure.legend, "below (default), above, right or none")->type_name("PLACE");
    verb.add_option("--colours", figure.colours,
                    "paper (default, differ in grey and for the colour blind), screen or grey")
        ->type_name("NAME");
    verb.add_option("--portraits", figure.portraits,
                    "curves in a plane: beside (a panel per scheme, default), density or over")
        ->type_name("NAME");
    verb.add_flag("--titles,!--no-titles", figure.hasTitles, "titles above the panels (default)");
    verb.add_flag("--equal", figure.isEqual, "in portraits one unit is as long on both axes");
    verb.add_option("--times", figure.times, "the window of time that is shown")->type_name("FROM:TO");
    verb.add_option("--caption", figure.caption, "in place of one that names panels and schemes")
        ->type_name("TEXT");
    verb.add_flag("--draw-caption", figure.isCaptionDrawn, "the caption in the picture as well");
    addCommon(verb, arguments.common);
}

void addPage(CLI::App& app, Arguments& arguments) {
    CLI::App& verb =
        addVerb(app, arguments, "page", "a page for browsers, in one file, on which the motion plays", true);
    verb.add_option("--out", arguments.page.out, "the page: .html")->required()->type_name("FILE");
    verb.add_option("--frames", arguments.page.frames, "pictures of the motion, 0 to 600; 90 by default")
        ->type_name("N")
        ->check(CLI::Range(0, 600).description(""));
    addCommon(verb, arguments.common);
}

/// What is wanted of a search, and what it searches.
void addSearch(CLI::App& verb, StudyOptions& study) {
    verb.add_option("--error", study.error,
                    "for cheapest, limits and extremes: the error to be reached, a wish for --metric; for "
                    "needs: a rung of the ladder")
        ->type_name("E");
    verb.add_option("--wish", study.wishes,
                    "for cheapest, limits and extremes: a metric and the value it stays below; repeatable, "
                    "all must hold; for needs: a rung of the ladder, 0.1 to 1e-12 by default")
        ->type_name("METRIC=VALUE")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    verb.add_option(
            "--budget", study.budget,
            "for cheapest: the smallest error for this CPU time of a run (1ms), or of a second of its "
            "motion (1ms/s)")
        ->type_name("TIME[/s]");
    verb.add_option(
            "--memory", study.memory,
            "for cheapest and needs: what a run of a scheme may hold at most (64kB, 10MB, 1GB), tables "
            "that all runs share apart; the column bytes says what it holds")
        ->type_name("SIZE");
    verb.add_option("--candidates", study.candidates,
                    "for cheapest: the schemes of the scene (default), or all that accept it; for needs all "
                    "by default")
        ->type_name("scene|all");
    verb.add_option(
            "--over", study.over,
            "for cheapest and needs: values of a number of the scene, all of which one setting must serve")
        ->type_name("POINTER=A,B,C or POINTER=FROM:TO:N[:log]");
    verb.add_option("--of", study.of, "the errors over these: the worst (default) or the median")
        ->type_name("worst|median");
    verb.add_option(
            "--knobs", study.knobs,
            "for cheapest and needs: what is searched besides the step, all by default: degree (and "
            "nodes), cells (elements of fields), modes (of wave functions), harmonics (of oscillatory "
            "spaces), mesh-nodes (that move), courant, and if named tolerance (of the solver); for "
            "convergence and work-precision: step alone, or with cells")
        ->type_name("step,degree,cells,modes,harmonics,mesh-nodes,courant,tolerance");
    verb.add_option("--search-time", study.searchTime,
                    "for cheapest and needs: CPU time of the search, 1s and 4s by default; for limits "
                    "of each scheme, 2s")
        ->type_name("TIME");
}

/// `study KIND SCENE`, and `study merge DIR...`: one verb, whose first word decides.
void addStudy(CLI::App& app, Arguments& arguments) {
    StudyOptions& study = arguments.study;
    CLI::App& verb =
        addVerb(app, arguments, "study",
                "measure convergence, cost or stability over many runs (extremal list studies)", false);
    verb.add_option("KIND", study.kind, "a study, or merge to put shards together")
        ->required()
        ->type_name("");
    verb.add_option(
            "SCENE", study.folders,
            std::string(sceneHelp) + "; for merge the folders of the shards; none for extremes without --x")
        ->type_name("");
    verb.add_option("--out", study.out, "folder for the files, created if missing")
        ->required()
        ->type_name("DIR");
    verb.add_option("--metric", study.metric,
                    "error (default), energy, momentum, norm, phase, an observable, or a column: "
                    "error.theta, column:q.x, 2*error.x/own, rms(error.x/own, error.y/own)")
        ->type_name("NAME");
    verb.add_flag("--final", study.isFinal,
                  "the metric at the last node; its maximum over the run by default");
    // What these say together, and whether it is possible, is checked by engine/study/request.hpp.
    verb.add_option("--steps", study.steps, "the steps to run with, separated by commas")
        ->delimiter(',')
        ->type_name("A,B,C");
    verb.add_option("--from", study.from, "the largest step")->type_name("H");
    verb.add_option("--to", study.to, "the smallest step")->type_name("H");
    verb.add_option("--points", study.points, "steps from --from to --to in equal ratios; 12 by default")
        ->type_name("N");
    verb.add_option("--x", study.x, "for stability and extremes: a number of the scene and its values")
        ->type_name("POINTER=FROM:TO:N[:log]");
    verb.add_option("--y", study.y, "a second one")->type_name("POINTER=FROM:TO:N[:log]");
    verb.add_flag("--limit", study.findsLimits, "bisect the limit along --x to four digits");
    verb.add_flag("--long", study.isLong, "for extremes: also the runs of 10^9 steps, which take minutes");
    addSearch(verb, study);
    verb.add_option("--repeat", study.repeat, "timed runs per point, 5 by default; 0: no times")
        ->type_name("R");
    verb.add_option("--only", study.only, "the label of a scheme; repeatable")
        ->type_name("LABEL")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    verb.add_option("--shard", study.shard, "part I of N, to be merged later")->type_name("I/N");
    verb.add_flag("--plot,!--no-plot", study.isPlotted, "draw KIND.svg and KIND.png as well (default)");
    verb.add_flag("--resume", study.isResumed, "keep the points that the log in DIR has");
    addCommon(verb, arguments.common);
    verb.final_callback([&] {
        if (study.kind == "merge")
            arguments.verb = "study merge";
        else if (study.folders.size() <= 1)
            arguments.scene = study.folders.empty() ? "" : study.folders.front();
        else
            throw CLI::ExtrasError({study.folders.begin() + 1, study.folders.end()});
    });
}

void addAtlas(CLI::App& app, Arguments& arguments) {
    CLI::App& verb =
        addVerb(app, arguments, "atlas",
                "measure what every scheme claims, on a system of every kind; write a page", false);
    verb.add_option("--out", arguments.atlas.out,
                    "folder for index.html and its pictures, created if missing")
        ->required()
        ->type_name("DIR");
    verb.add_option("--systems", arguments.atlas.systems,
                    "presets in place of those of the atlas, with commas")
        ->delimiter(',')
        ->type_name("A,B,C");
    verb.add_flag("--quick", arguments.atlas.isQuick, "low degrees, few steps, costs measured once");
    verb.add_flag("--resume", arguments.atlas.isResumed, "keep the points that the logs in DIR have");
    addCommon(verb, arguments.common);
}

void addPassport(CLI::App& app, Arguments& arguments) {
    PassportRequest& passport = arguments.passport;
    CLI::App& verb =
        addVerb(app, arguments, "passport",
                "all that is known of a scheme: its action, tableau, order conditions, stability, "
                "measured orders",
                true);
    verb.add_option("--scheme", passport.scheme, "the label of a scheme; the first enabled one by default")
        ->type_name("LABEL");
    verb.add_option("--format", passport.format, "md, html or tex; by the ending of --out, else md")
        ->type_name("FORMAT")
        ->check(CLI::IsMember({"md", "html", "tex"}).description(""));
    verb.add_option("--out", passport.out, "the file; standard output by default")->type_name("FILE");
    verb.add_flag("--measure,!--no-measure", passport.isMeasured,
                  "run the scheme at five steps for its order and cost (default)");
    addCommon(verb, arguments.common);
}

void addProgram(CLI::App& app, Arguments& arguments) {
    ProgramRequest& program = arguments.program;
    CLI::App& verb = addVerb(app, arguments, "program",
                             "a scheme and the equations of its system as one C++ or Python file", true);
    verb.add_option("--out", program.out, "the file, which tests itself against the CSV of a run")
        ->required()
        ->type_name("FILE");
    verb.add_option("--scheme", program.scheme, "the label of a scheme; the first enabled one by default")
        ->type_name("LABEL");
    verb.add_option("--language", program.language, "cpp or python; by the ending of --out")
        ->type_name("NAME")
        ->check(CLI::IsMember({"cpp", "python"}).description(""));
    verb.add_option(
            "--with", program.with,
            "the numbers that the program differentiates its end by: /model/k,/initial/q/0; parameters "
            "and initial values of the scene by default")
        ->delimiter(',')
        ->type_name("POINTER,...");
    addCommon(verb, arguments.common);
}

void addFormulas(CLI::App& app, Arguments& arguments) {
    CLI::App& verb =
        addVerb(app, arguments, "formulas",
                "the same scene with its model as a typed Lagrangian, or the equations of motion", true);
    verb.add_option("--out", arguments.formulas.out, "the file; standard output by default")
        ->type_name("FILE");
    verb.add_option("--equations", arguments.formulas.equations,
                    "the equations of motion in place of the scene: text or tex")
        ->type_name("FORM")
        ->check(CLI::IsMember({"text", "tex"}).description(""));
    addCommon(verb, arguments.common);
}

void addWisdom(CLI::App& app, Arguments& arguments) {
    CLI::App& verb =
        addVerb(app, arguments, "wisdom",
                "measure the fastest Fourier transforms of this machine, for EXTREMAL_WISDOM", false);
    verb.add_option("--out", arguments.wisdom.out, "the file; an existing one is extended")
        ->required()
        ->type_name("FILE");
    verb.add_option("--modes", arguments.wisdom.modes, "a number of modes, or NxM in the plane; repeatable")
        ->required()
        ->type_name("N")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    addCommon(verb, arguments.common);
}

}  // namespace

CLI::Validator finiteNumber() { return numberIn(-HUGE_VAL, HUGE_VAL); }

void addCommon(CLI::App& verb, CommonOptions& options) {
    const bool isProgram = !verb.get_parent();
    const auto isTaken = [&](const char* option) { return isProgram || takes(verb.get_name(), option); };
    std::vector<CLI::Option*> added;
    if (isTaken("--set"))
        added.push_back(verb.add_option("--set", options.overrides,
                                        "change a value of the scene: --set '/schemes/*/step=0.1'; "
                                        "repeatable")
                            ->type_name("POINTER=VALUE")
                            ->expected(1)
                            ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll));
    if (isTaken("--add"))
        added.push_back(
            verb.add_option("--add", options.added,
                            "a scheme of your own, by its name in your catalogue or a file it was "
                            "exported to; repeatable, before --set")
                ->type_name("SCHEME")
                ->expected(1)
                ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll));
    if (isTaken("--json"))
        added.push_back(verb.add_flag("--json", options.isJson, "one JSON document on standard output"));
    if (isTaken("--quiet")) added.push_back(verb.add_flag("--quiet", options.isQuiet, "errors only"));
    if (isTaken("--trust"))
        added.push_back(verb.add_flag("--trust", options.isTrusted,
                                      "read files that the scene names outside its own folder"));
    if (isTaken("--force"))
        added.push_back(verb.add_flag("--force", options.isForced,
                                      "replace files in --out that this program did not write"));
    if (isTaken("--threads"))
        added.push_back(
            verb.add_option("--threads", options.threads, "threads to use, 1 to 1024; all cores by default")
                ->type_name("N")
                ->check(CLI::Range(1U, 1024U).description("")));
    if (isProgram)
        for (CLI::Option* option : added) option->group("Options of verbs, before or behind the verb");
    verb.set_help_flag("--help,-h", "this text");
}

CLI::App& addVerb(CLI::App& app, Arguments& arguments, const char* name, const char* description,
                  bool takesScene) {
    CLI::App* verb = app.add_subcommand(name, description);
    if (takesScene) verb->add_option("SCENE", arguments.scene, sceneHelp)->required()->type_name("");
    verb->parse_complete_callback([&arguments, name] { arguments.verb = name; });
    return *verb;
}

const std::vector<std::pair<std::string, std::vector<std::string>>>& examples() {
    static const std::vector<std::pair<std::string, std::vector<std::string>>> all = {
        {"", {"extremal preset:kepler", "extremal run preset:kepler --out kepler", "extremal run --help"}},
        {"run",
         {"extremal run preset:pendulum --out pendulum",
          "extremal run preset:kepler --set '/schemes/*/step=0.1' --set /time/end=20 --out kepler",
          "extremal run preset:kepler --set /time/end=1e4 --out long --resume"}},
        {"snapshot",
         {"extremal snapshot preset:pendulum --out pendulum.png",
          "extremal snapshot preset:kepler --view energy --size 900x600 --out energy.svg"}},
        {"figure",
         {"extremal figure preset:kepler --view energy --view phase --out kepler.pdf",
          "extremal figure preset:kepler --width page --portraits density --font 'DejaVu Serif' --out "
          "wide.svg"}},
        {"page", {"extremal page preset:kepler --out kepler.html"}},
        {"passport",
         {"extremal passport preset:pendulum --no-measure",
          "extremal passport preset:kepler --set '/schemes/-={\"label\": \"G4\", \"scheme\": "
          "\"galerkin-gauss-4\", \"step\": 0.1}' --scheme G4 --out passport.html"}},
        {"program",
         {"extremal program preset:pendulum --out pendulum.cpp",
          "extremal program preset:kepler --out kepler.py",
          "extremal program preset:pendulum --with /model/l,/initial/q/0 --out pendulum.py"}},
        {"orbit",
         {"extremal orbit preset:pendulum --out orbit",
          "extremal orbit preset:orbits --follow energy=0.125 --out family",
          "extremal orbit preset:kepler --set '/initial={\"q\": [1, 0], \"q1\": [0, 1], \"at\": 1.5}' "
          "--out arrivals"}},
        {"fit",
         {"extremal run preset:pendulum --out run && extremal fit preset:pendulum --data run/rk4.csv "
          "--columns q.theta --free /model/l --out fit"}},
        {"motions",
         {"extremal run preset:kepler --out run && extremal motions preset:kepler --starts run/rk4.csv "
          "--out motions"}},
        {"gradient",
         {"extremal gradient preset:pendulum --of 'theta^2/2' --with /model/l,/model/g,/initial/q/0 "
          "--out gradient"}},
        {"steer", {"extremal steer preset:swing-up --over 'u^2/2' --end theta-pi --end p_theta --out steer"}},
        {"formulas",
         {"extremal formulas preset:four-bar-by-hand --out four-bar.json",
          "extremal formulas preset:banana --equations tex"}},
        {"check",
         {"extremal check preset:kepler",
          "extremal check preset:kepler --set '/schemes/-={\"scheme\": \"galerkin-gauss-4\", \"step\": "
          "0.2}'"}},
        {"list", {"extremal list schemes", "extremal list models --json"}},
        {"handbook", {"extremal handbook", "extremal handbook multiscale#resonances"}},
        {"study",
         {"extremal study convergence preset:pendulum --repeat 0 --out orders",
          "extremal study cheapest preset:pendulum --error 1e-4 --repeat 1 --out cheapest",
          "extremal study needs preset:spring-pendulum --metric error.theta --out needs",
          "extremal study stability preset:pendulum --x '/schemes/*/step=0.1:1:4' --out stability"}},
        {"atlas",
         {"extremal atlas --quick --out atlas", "extremal atlas --systems kepler,pendulum --out atlas"}},
        {"wisdom", {"extremal wisdom --modes 256 --out wisdom.fftw"}},
        {"completion",
         {"extremal completion bash > extremal.bash", "extremal completion fish > extremal.fish"}},
        {"manual", {"extremal manual > extremal.1"}}};
    return all;
}

std::unique_ptr<CLI::App> makeInterface(Arguments& arguments) {
    auto interface = std::make_unique<CLI::App>(
        "Extremal compares variational integrators: a scene in; trajectories, plots and costs out.",
        "extremal");
    CLI::App& app = *interface;
    app.add_flag("--version", arguments.isVersion, "the version; with --verbose also of every library");
    app.add_flag("--verbose", arguments.isVerbose, "for --version")->needs("--version");
    app.add_option("SCENE", arguments.scene, std::string(sceneHelp) + "; opens the window on it")
        ->type_name("");
    addCommon(app, arguments.common);
    CLI::App& run =
        addVerb(app, arguments, "run", "integrate every enabled scheme; write CSV files and a summary", true);
    run.add_option("--out", arguments.run.out, "folder for the files, created if missing")
        ->required()
        ->type_name("DIR");
    run.add_flag("--resume", arguments.run.isResumed,
                 "go on from the checkpoints in DIR of a run that was ended");
    run.add_option("--checkpoint", arguments.run.checkpoint,
                   "seconds between checkpoints, 20 by default; 0: none")
        ->type_name("SECONDS")
        ->check(numberIn(0, 1e6));
    addCommon(run, arguments.common);
    addSnapshot(app, arguments);
    addFigure(app, arguments);
    addPage(app, arguments);
    addPassport(app, arguments);
    addProgram(app, arguments);
    addAnswers(app, arguments);
    addFormulas(app, arguments);
    addCommon(addVerb(app, arguments, "check", "report every error and warning of a scene", true),
              arguments.common);
    CLI::App& list = addVerb(app, arguments, "list", "list what a scene may contain", false);
    list.add_option(
            "KIND", arguments.kind,
            "models, spaces, quadratures, schemes, baselines, compositions, observables, studies, views, "
            "profiles or presets")
        ->type_name("");
    addCommon(list, arguments.common);
    CLI::App& handbook =
        addVerb(app, arguments, "handbook", "a page of the handbook, or a section of it", false);
    handbook.add_option("PAGE", arguments.kind, "its name, or PAGE#HEADING; by default the list of pages")
        ->type_name("");
    addCommon(handbook, arguments.common);
    addStudy(app, arguments);
    addAtlas(app, arguments);
    addWisdom(app, arguments);
    CLI::App& completion = addVerb(app, arguments, "completion", "the completions of a shell", false);
    completion.add_option("SHELL", arguments.kind, "bash, zsh or fish")->required()->type_name("");
    addCommon(completion, arguments.common);
    addCommon(addVerb(app, arguments, "manual", "this help as a manual page, for man -l -", false),
              arguments.common);
    for (const auto& [verb, lines] : examples()) {
        std::string text = "Examples:";
        for (const std::string& line : lines) text.append("\n  ").append(line);
        (verb.empty() ? &app : app.get_subcommand(verb))->footer(text);
    }
    app.require_subcommand(0, 1);
    for (const auto& [label, word] :
         {std::pair{"SUBCOMMAND", "VERB"}, {"Subcommands", "Verbs"}, {"REQUIRED", "(required)"}})
        app.get_formatter()->label(label, word);
    return interface;
}

}  // namespace extremal::app
