// SPDX-License-Identifier: GPL-3.0-or-later
/// The files of an answer that is not a run (an orbit, a fit): scene.json, tables, and NAME.json, the
/// document of the answer, which lists them and has the fingerprint of the scene, so that they are known for
/// the program's own (run/files/replacing.hpp).
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/value.hpp"
#include "engine/run/files/replacing.hpp"

namespace extremal {

struct AnswerFiles {
    std::string name;   ///< "orbit": of the document, without its ending
    Value document;     ///< an object
    std::string scene;  ///< the text of scene.json; empty: there is none
    std::vector<std::pair<std::string, std::string>> tables;  ///< names and texts
};

/// Writes all of them or none into the folder, which is made if missing; returns their names. Throws what
/// requireReplaceable does, and ExportError.
std::vector<std::string> writeAnswer(const AnswerFiles& answer, const std::filesystem::path& folder,
                                     const Replacing& replacing);

}  // namespace extremal
