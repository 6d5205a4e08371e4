// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/arguments.hpp"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include <CLI/CLI.hpp>

#include "app/interface.hpp"
#include "app/option_table.hpp"
#include "app/report.hpp"
#include "engine/core/text/text.hpp"

namespace extremal::app {
namespace {

std::vector<std::string> optionsOf(const CLI::App& verb) {
    std::vector<std::string> names;
    for (const CLI::Option* option : verb.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    return names;
}

/// The first option among the arguments that the verb does not have; empty: there is none.
std::string unknownOption(const CLI::App& verb, int argc, char** argv) {
    const std::vector<std::string> known = optionsOf(verb);
    for (int i = 1; i < argc; ++i) {
        const std::string_view argument = argv[i];
        if (argument == "--") break;
        const std::string name(argument.substr(0, argument.find('=')));
        if (name.starts_with("--") && std::find(known.begin(), known.end(), name) == known.end()) return name;
    }
    return {};
}

/// What CLI11 says, as a sentence of ours.
void printParseError(const CLI::App& app, const CLI::ParseError& error, const Arguments& arguments, int argc,
                     char** argv) {
    std::vector<std::string> verbs;
    for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
        verbs.push_back(verb->get_name());
    std::string what = error.what(), hint = "see extremal --help";
    const auto parsed = app.get_subcommands();
    const CLI::App& verb = parsed.empty() ? app : *parsed.front();
    if (!parsed.empty()) hint = "see extremal " + verb.get_name() + " --help";
    // A mistyped verb is taken for a scene.
    const std::string near = nearestName(arguments.scene, verbs);
    if (parsed.empty() && !near.empty() && !std::filesystem::exists(arguments.scene)) {
        what = "unknown verb \"" + arguments.scene + "\"";
        hint = "did you mean \"" + near + "\"?";
    } else if (const std::string option = unknownOption(verb, argc, argv); !option.empty()) {
        what = "unknown option " + option + (parsed.empty() ? "" : " of " + verb.get_name());
        const std::string meant = nearestName(option, optionsOf(verb));
        if (const auto others = takersOf(option, false); !others.empty())
            hint = joinNames(others) + (others.size() > 1 ? " have it" : " has it");
        else if (!meant.empty())
            hint = "did you mean " + meant + "?";
    }
    printProblem("arguments", what, hint);
}

/// The row of the table that the arguments ask for; null: there is no such study.
const VerbOptions* rowOf(const Arguments& arguments) {
    std::string verb = arguments.verb;
    if (verb == "study") verb += " " + arguments.study.kind;
    const auto& table = optionTable();
    const auto row =
        std::find_if(table.begin(), table.end(), [&](const VerbOptions& each) { return each.verb == verb; });
    return row == table.end() ? nullptr : &*row;
}

/// Options that the verb, or the study, would ignore; empty: there is no such option.
std::string ignoredOption(const CLI::App& app, const VerbOptions& row) {
    std::vector<const CLI::App*> parsed{&app};
    for (const CLI::App* verb : app.get_subcommands()) parsed.push_back(verb);
    for (const CLI::App* part : parsed)
        for (const CLI::Option* option : part->get_options()) {
            if (option->count() == 0 || option->get_lnames().empty()) continue;
            const std::string name = "--" + option->get_lnames().front();
            if (!has(row, name)) return name;
        }
    return {};
}

/// Whether every argument has a meaning; prints the first that has none.
bool isObeyed(const CLI::App& app, const Arguments& arguments) {
    const VerbOptions* const row = rowOf(arguments);
    if (!row) return true;  // the verb says which studies there are
    const std::string verb = row->verb.empty() ? "the window" : std::string(row->verb);
    if (const std::string option = ignoredOption(app, *row); !option.empty()) {
        const auto others = takersOf(option, row->verb.starts_with("study"));
        printProblem(option, "is not an option of " + verb,
                     joinNames(others) + (others.size() > 1 ? " have it" : " has it"));
        return false;
    }
    const bool hasSceneBefore = app.get_option("SCENE")->count() > 0;
    if (hasSceneBefore && (!row->verb.empty() || arguments.isVersion)) {
        printProblem("arguments",
                     "a scene before " + (row->verb.empty() ? "--version" : verb) + " has no meaning",
                     "see extremal --help");
        return false;
    }
    if (row->verb == "study extremes" && !arguments.scene.empty() && arguments.study.x.empty()) {
        printProblem("arguments",
                     "study extremes takes no SCENE without --x, got \"" + arguments.scene + "\"",
                     "it has scenes of its own; with --x POINTER=FROM:TO:N it takes a number of yours");
        return false;
    }
    if (row->verb == "study merge" && arguments.study.folders.empty()) {
        printProblem("arguments", "study merge needs the folders of the shards", "see extremal study --help");
        return false;
    }
    return true;
}

}  // namespace

std::optional<Arguments> parseArguments(int argc, char** argv, int& exitCode) {
    Arguments arguments;
    const std::unique_ptr<CLI::App> interface = makeInterface(arguments);
    CLI::App& app = *interface;
    try {
        app.parse(argc, argv);
        if (isObeyed(app, arguments)) return arguments;
        exitCode = unusable;
        return {};
    } catch (const CLI::ParseError& error) {
        exitCode = unusable;
        if (error.get_exit_code() != 0) {
            printParseError(app, error, arguments, argc, argv);
        } else {
            std::ostringstream text;
            exitCode = app.exit(error, text);
            exitCode = print(text.str(), exitCode);
        }
        return {};
    }
}

}  // namespace extremal::app
