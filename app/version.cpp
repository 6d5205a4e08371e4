// SPDX-License-Identifier: GPL-3.0-or-later
#include <QtGlobal>

#include <exception>
#include <string>

#include "app/offscreen.hpp"
#include "app/report.hpp"
#include "app/verbs.hpp"
#include "commit.hpp"
#include "engine/core/algebra/instruction_set.hpp"
#include "engine/core/libraries.hpp"
#include "ui/stage/gl/surface.hpp"

namespace extremal::app {
namespace {

/// What draws the stage without a display, as OpenGL names itself.
std::string drawingBackend() {
    try {
        const Offscreen qt;
        return describeSurface(*makeHeadlessSurface());
    } catch (const std::exception& e) {
        return std::string("none: ") + e.what();
    }
}

}  // namespace

std::string versionText() { return EXTREMAL_VERSION " " EXTREMAL_COMMIT; }

int versionVerb(bool isVerbose) {
    std::string text = "extremal " EXTREMAL_VERSION "\n";
    if (isVerbose) {
        Table table;
        table.rows = {{"commit", EXTREMAL_COMMIT},
                      {"compiler", __VERSION__},
                      {"instruction set", std::string(name(instructionSet()))},
                      {"stage", drawingBackend()},
                      {"Qt", qVersion()}};
        for (const auto& [library, version] : libraries()) table.rows.push_back({library, version});
        text += table.text();
    }
    return print(text, done);
}

}  // namespace extremal::app
