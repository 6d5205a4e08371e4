// SPDX-License-Identifier: GPL-3.0-or-later
/// The outcome of running a scene: one result per scheme, ready for plots, tables and files.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/outcome.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/step_events.hpp"
#include "engine/run/products.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/trajectory/trajectory.hpp"

namespace extremal {

enum class RunStatus { waiting, running, done, partial, failed };
constexpr const char* name(RunStatus s) {
    switch (s) {
        case RunStatus::waiting:
            return "waiting";
        case RunStatus::running:
            return "running";
        case RunStatus::done:
            return "done";
        case RunStatus::partial:
            return "partial";
        case RunStatus::failed:
            return "failed";
    }
    return "";
}

/// A row of summary.csv. NaN or empty: not asked for.
struct Summary {
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    std::string label;
    RunStatus status = RunStatus::waiting;
    Outcome cause = Outcome::converged;
    double failedAt = unknown;  ///< t of the node from which the step failed
    double tEnd = unknown;
    long long steps = 0;
    Cost cost = {};
    double cpuSeconds = 0;  ///< thread CPU time of the scheme's steps alone
    double maxEnergyError = unknown;
    double energyDrift = unknown;  ///< per unit time
    double maxMomentumError = unknown, maxNormError = unknown, maxError = unknown, finalError = unknown;
    /// The largest size over every node of the column that an observable declares for it.
    struct Extreme {
        std::string observable, column;
        double value = unknown;
    };
    std::vector<Extreme> extremes = {};
    /// The member above that is the extreme of an observable, or null.
    static double Summary::*memberOf(std::string_view observable) {
        if (observable == "energy") return &Summary::maxEnergyError;
        if (observable == "momentum") return &Summary::maxMomentumError;
        if (observable == "norm") return &Summary::maxNormError;
        if (observable == "constraint") return &Summary::maxConstraint;
        return observable == "error" ? &Summary::maxError : nullptr;
    }
    int orderClaimed = 0;  ///< 0: no claim
    double orderMeasured = unknown;
    double maxConstraint = unknown;
    double floor = unknown;    ///< errors below it say nothing of the scheme
    std::string floorOf;       ///< "reference" or "round-off"; empty: unknown
    double impacts = unknown;  ///< on walls; of systems without walls not asked for
    double opensAt = unknown;  ///< t from which the error by a companion is too large to be true
    std::string advice;        ///< after a failure: what to try; for the window, not exported
    std::string about;         ///< how the scheme solves its equations, where that was a choice; not exported
    std::string caution;       ///< what is doubtful in a result that looks sound ("under-resolved: ..")

    /// What grows along a march.
    void checkpoint(Archive& archive) {
        archive(maxEnergyError, maxMomentumError, maxNormError, maxError, finalError, maxConstraint, impacts,
                caution);
        for (Extreme& each : extremes) archive(each.value);
    }
};

struct SchemeResult {
    SchemeSpec spec;
    std::shared_ptr<const ResolvedScheme> scheme = {};  ///< what it resolved to; null in hand-made results
    int style = 0;                                      ///< number of colour and dash (styleOf)
    double fraction = 0;                                ///< of the time interval covered, 0..1
    Trajectory trajectory;
    Summary summary;
    StepEvents events = {};  ///< what happened in its steps besides going on
    Products products = {};
};

struct ReferenceInfo {
    std::string type = "none";  ///< "exact", "computed", "scheme", "file", "companion", "none"
    double estimatedError = Summary::unknown;
    std::string description;             ///< "Gauss(12), h = 0.01": for the window
    std::vector<Problem> problems = {};  ///< why there is none although the scene asks for one
    // Of a computed one, what a method of another kind says (run/reference/members.hpp).
    std::string chosen = {}, confirmedBy = {};  ///< the two methods; empty: no method of another kind
    double agreed = Summary::unknown;           ///< the largest distance of the two over the run
    double bound = Summary::unknown;            ///< of its error over the run
    double horizon = Summary::unknown;  ///< t up to which errors can be judged; unknown: all of the run
    struct At {
        double t = 0, value = 0;
    };
    std::vector<At> boundAlong = {};  ///< the bound up to t, where errors cannot be judged all along
    std::vector<At> pulses = {};      ///< of the force: when, and how wide
    std::string caution = {};         ///< what cannot be judged, in words
};

inline ReferenceInfo companionInfo() {
    return {"companion", Summary::unknown, "each scheme with one degree more", {}};
}

/// Immutable once published; shared between threads by pointer. Holds only enabled schemes.
struct Comparison {
    Scene scene;
    std::shared_ptr<const System> system = {};  ///< that of the scene; null in hand-made comparisons
    std::vector<std::shared_ptr<const SchemeResult>> schemes;
    ReferenceInfo reference;
    Products products = {};  ///< of all schemes together
    bool isFinished = false;
};

/// Whether there are results besides those of its schemes, which change while these stay.
inline bool hasFurtherProducts(const Comparison& comparison) {
    return comparison.products.find<ParameterMaps>() || comparison.products.find<StartSets>();
}

}  // namespace extremal
