// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/CLI.hpp>

#include "app/interface.hpp"

namespace extremal::app {
namespace {

/// Where the files go, and of which scheme they are.
template <class Options>
void addPlace(CLI::App& verb, Options& options) {
    verb.add_option("--out", options.out, "folder for the files, created if missing")
        ->required()
        ->type_name("DIR");
    verb.add_option("--scheme", options.scheme, "the label of a scheme; the first enabled one by default")
        ->type_name("LABEL");
}

void addOrbit(CLI::App& app, Arguments& arguments) {
    OrbitOptions& orbit = arguments.orbit;
    CLI::App& verb = addVerb(
        app, arguments, "orbit",
        "the periodic orbit near the start of a scene, its multipliers and its family; of a scene with "
        "two positions the motions between them",
        true);
    addPlace(verb, orbit);
    verb.add_option(
            "--period", orbit.period,
            "the period of the drive, or a first guess: a number, or an expression in the parameters; "
            "by default the length of the scene, or where its motion comes back")
        ->type_name("T");
    verb.add_option("--energy", orbit.energy, "that the orbit is to have; that of the start by default")
        ->type_name("E")
        ->check(finiteNumber());
    verb.add_option("--hold", orbit.hold, "what picks one orbit of a family: energy (default) or period")
        ->type_name("NAME");
    verb.add_option("--follow", orbit.follow,
                    "the family from this orbit to another energy or period, or along a number of the scene")
        ->type_name("NAME=VALUE");
    verb.add_option("--guess", orbit.momenta,
                    "between two positions: the momentum to begin with, where there are several motions")
        ->delimiter(',')
        ->type_name("P,...");
    verb.add_option("--points", orbit.points, "orbits on the way, about; 20 by default")->type_name("N");
    verb.add_option("--manifold", orbit.manifold,
                    "unstable or stable: its starts, in the section of scene.json, of an orbit that has one")
        ->type_name("NAME");
    verb.add_option("--starts", orbit.starts, "of the manifold; 200 by default")->type_name("N");
    addCommon(verb, arguments.common);
}

void addFit(CLI::App& app, Arguments& arguments) {
    FitOptions& fit = arguments.fit;
    CLI::App& verb =
        addVerb(app, arguments, "fit",
                "numbers of a scene from measurements of its motion, with their deviations", true);
    verb.add_option("--data", fit.data,
                    "a CSV with t and measured columns; sd.NAME or weight.NAME beside them")
        ->required()
        ->type_name("FILE");
    verb.add_option("--free", fit.free, "the numbers to fit: /model/k,/initial/q/0")
        ->required()
        ->delimiter(',')
        ->type_name("POINTER,...");
    verb.add_option("--columns", fit.columns, "the columns to compare; all of the file by default")
        ->delimiter(',')
        ->type_name("NAME,...");
    addPlace(verb, fit);
    verb.add_flag("--bias,!--no-bias", fit.measuresBias,
                  "fit with half the step as well, for the bias of the scheme (default)");
    addCommon(verb, arguments.common);
}

void addMotions(CLI::App& app, Arguments& arguments) {
    MotionsOptions& motions = arguments.motions;
    CLI::App& verb = addVerb(app, arguments, "motions",
                             "the motions of one scheme from many starts, and where each ends", true);
    verb.add_option("--starts", motions.starts,
                    "a CSV with the columns of the state, a start in each row: that of a run will do")
        ->required()
        ->type_name("FILE");
    addPlace(verb, motions);
    addCommon(verb, arguments.common);
}

void addGradient(CLI::App& app, Arguments& arguments) {
    GradientOptions& gradient = arguments.gradient;
    CLI::App& verb = addVerb(
        app, arguments, "gradient",
        "derivatives of a number of the run by many numbers of the scene, in one sweep backwards", true);
    verb.add_option("--of", gradient.of,
                    "a formula at the end, in coordinates, momenta p_NAME, t and parameters")
        ->type_name("FORMULA");
    verb.add_option("--over", gradient.over,
                    "a formula that is integrated over the run, in what the model's own formulas know")
        ->type_name("FORMULA");
    verb.add_option("--with", gradient.with,
                    "the numbers: /model/k,/initial/q/0; of a control by a table all its rows: "
                    "/model/controls/u")
        ->required()
        ->delimiter(',')
        ->type_name("POINTER,...");
    addPlace(verb, gradient);
    addCommon(verb, arguments.common);
}

void addSteer(CLI::App& app, Arguments& arguments) {
    SteerOptions& steer = arguments.steer;
    CLI::App& verb = addVerb(app, arguments, "steer",
                             "the controls of the model that make a cost of the run least, with conditions "
                             "at its end, and their costates",
                             true);
    verb.add_option("--over", steer.over,
                    "the cost that is integrated over the run, in what the model's own formulas know: u^2/2")
        ->type_name("FORMULA");
    verb.add_option("--of", steer.of, "the cost at the end, in coordinates, momenta p_NAME, t and parameters")
        ->type_name("FORMULA");
    verb.add_option("--end", steer.conditions,
                    "what is to be 0 at the end, a formula as in --of; may be repeated")
        ->type_name("FORMULA");
    verb.add_option("--control", steer.controls, "the controls that are free; by default all of the model")
        ->delimiter(',')
        ->type_name("NAME,...");
    verb.add_option("--bounds", steer.bounds, "of a control: u=-1:1, u=0:; may be repeated")
        ->type_name("NAME=A:B");
    addPlace(verb, steer);
    addCommon(verb, arguments.common);
}

}  // namespace

void addAnswers(CLI::App& app, Arguments& arguments) {
    addOrbit(app, arguments);
    addFit(app, arguments);
    addMotions(app, arguments);
    addGradient(app, arguments);
    addSteer(app, arguments);
}

}  // namespace extremal::app
