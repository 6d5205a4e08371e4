#include "app/arguments.hpp"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include <CLI/CLI.hpp>

#include "app/interface.hpp"
#include "app/report.hpp"
#include "engine/core/text.hpp"

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

/// The verbs that have an option.
std::vector<std::string> verbsWith(const CLI::App& app, const std::string& option) {
    std::vector<std::string> verbs;
    for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
        const std::vector<std::string> options = optionsOf(*verb);
        if (std::find(options.begin(), options.end(), option) != options.end())
            verbs.push_back(verb->get_name());
    }
    return verbs;
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
        if (const auto others = verbsWith(app, option); !others.empty())
            hint = joinNames(others) + (others.size() > 1 ? " have it" : " has it");
        else if (!meant.empty())
            hint = "did you mean " + meant + "?";
    }
    printProblem("arguments", what, hint);
}

}  // namespace

std::optional<Arguments> parseArguments(int argc, char** argv, int& exitCode) {
    Arguments arguments;
    const std::unique_ptr<CLI::App> interface = makeInterface(arguments);
    CLI::App& app = *interface;
    try {
        app.parse(argc, argv);
        return arguments;
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
