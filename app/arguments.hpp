// SPDX-License-Identifier: GPL-3.0-or-later
/// The command line as a value.
#pragma once

#include <optional>
#include <string>

#include "app/verbs.hpp"

namespace extremal::app {

struct Arguments {
    std::string verb;  ///< empty: the window
    std::string scene, kind;
    bool isVersion = false, isVerbose = false;
    CommonOptions common;
    RunVerbOptions run;
    SnapshotOptions snapshot;
    FigureOptions figure;
    PageOptions page;
    StudyOptions study;
    WisdomOptions wisdom;
    AtlasRunOptions atlas;
    PassportRequest passport;
    ProgramRequest program;
    OrbitOptions orbit;
    FitOptions fit;
    MotionsOptions motions;
    GradientOptions gradient;
    SteerOptions steer;
    FormulasRequest formulas;
};

/// Reads the arguments. Empty if there is nothing left to do (--help, --version, or an error that was
/// printed): then `exitCode` is set.
std::optional<Arguments> parseArguments(int argc, char** argv, int& exitCode);

}  // namespace extremal::app
