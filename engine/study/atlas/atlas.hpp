// SPDX-License-Identifier: GPL-3.0-or-later
/// The atlas: on one system after the other every named scheme and every baseline that fits it, so that what
/// a scheme claims stands beside what is measured.
///
/// A system is a scene that is supplied with the program, with its schemes replaced. Of each there is one
/// sweep for the errors and costs over six steps, and one each for the largest error of energy, momentum,
/// norm and phase at the step of the scene. Each of them has a log of its own (study_log.hpp), so that an
/// atlas is taken up where it was left.
#pragma once

#include <string>
#include <vector>

#include "engine/study/convergence.hpp"
#include "engine/study/sweep.hpp"

namespace extremal {

struct AtlasOptions {
    std::vector<std::string> systems = {};  ///< names of presets; empty: atlasSystems()
    bool isQuick = false;                   ///< low degrees, four steps, costs measured once
    unsigned threads = 0;
};

/// The presets that are in the atlas: systems with coordinates, bodies, wave functions and fields.
const std::vector<std::string>& atlasSystems();

struct AtlasPart {
    std::string metric;
    Sweep sweep;
    std::string logName(const std::string& system) const { return system + "." + metric; }
};

struct AtlasSystem {
    std::string id;                ///< of the preset
    std::string title;             ///< of the scene
    double step = 0;               ///< at which schemes are compared
    std::vector<AtlasPart> parts;  ///< errors first
    const Sweep& errors() const { return parts.front().sweep; }
};

/// Throws InvalidScene ("--systems") where there is no such preset, or one without a step or reference.
AtlasSystem atlasSystem(const std::string& preset, const AtlasOptions& options);

/// What the atlas says of one scheme on one system.
struct AtlasRow {
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    struct Measured {
        std::string metric;
        double value = unknown;
    };
    std::string label;
    Claims claims;
    OrderFit order;
    double size = 1;                            ///< of the state at the start
    double error = unknown, seconds = unknown;  ///< at the step
    std::vector<Measured> metrics;              ///< at the step: energy, momentum, ...
    double secondsForError = unknown;           ///< for an error of 1e-6
    std::string cause;                          ///< why it did not reach the end at the step; else empty

    enum class Verdict { kept, below, unknown };
    /// The measured order is at most 0.3 below the claimed one; unknown where none could be measured, where
    /// errors hardly change with the step (the mesh decides), or where they stay above a hundredth of the
    /// state, so that steps are too long for an order.
    Verdict orderVerdict() const;
    /// What a scheme claims to conserve changes by at most 1e-9; unknown where it claims nothing of the kind.
    Verdict verdictOf(const Measured& measured) const;
};
std::vector<AtlasRow> rowsOf(const AtlasSystem& system);

/// The page of the systems, as HTML that needs nothing but the pictures <id>.svg beside it. `machine`: what
/// it was measured on; `isComplete`: false where it was interrupted.
std::string atlasPage(const std::vector<AtlasSystem>& systems, const std::string& version,
                      const std::string& machine, bool isComplete);

}  // namespace extremal
