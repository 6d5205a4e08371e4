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
}

namespace extremal::app {

/// Reads into `arguments`, which must outlive it.
std::unique_ptr<CLI::App> makeInterface(Arguments& arguments);

/// By verb, empty for the program itself: commands as a user types them. Tests run them.
const std::vector<std::pair<std::string, std::vector<std::string>>>& examples();

}  // namespace extremal::app
