// SPDX-License-Identifier: GPL-3.0-or-later
/// The verbs and options of the command line, with their descriptions: --help, manual page and completions of
/// shells are made from them.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/arguments.hpp"

namespace CLI {
class App;
class Validator;
}  // namespace CLI

namespace extremal::app {

/// Reads into `arguments`, which must outlive it.
std::unique_ptr<CLI::App> makeInterface(Arguments& arguments);

/// By verb, empty for the program itself: commands as a user types them. Tests run them.
const std::vector<std::pair<std::string, std::vector<std::string>>>& examples();

// What verbs are made of, for app/interface*.cpp.

CLI::Validator finiteNumber();

/// The options that many verbs take, as far as this one does (option_table.hpp). Those of the program itself
/// stand before a verb, which takes them or not.
void addCommon(CLI::App& verb, CommonOptions& options);

CLI::App& addVerb(CLI::App& app, Arguments& arguments, const char* name, const char* description,
                  bool takesScene);

/// The verbs orbit, fit, gradient and steer, whose answers are not runs.
void addAnswers(CLI::App& app, Arguments& arguments);

}  // namespace extremal::app
