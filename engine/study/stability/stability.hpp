// SPDX-License-Identifier: GPL-3.0-or-later
/// How a scheme behaves where one or two numbers of a scene vary: stable, drifting, blowing up, or failing.
///
///     blow-up        a state that is not finite, or larger than 10^6 times its size at the start, or a
///                    motion that was lost (run/march/motion_check.hpp) and has not come back by the end
///     solver-failed  a step that found no solution
///     drifting       the line through the energy errors rises, over the run, by more than twice their
///                    scatter
///     stable         anything else
///
/// Growth is log(|x_end| / |x_start|) per unit of time, up to where the run ended. The limit along an axis is
/// the first value from which the scheme no longer keeps to a bounded band (blow-up or solver-failed): found
/// on the axis's own values, then bisected to four digits.
#pragma once

#include <limits>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/outcome.hpp"
#include "engine/scene/scene.hpp"
#include "engine/study/stability/judgement.hpp"

namespace extremal {

enum class StabilityClass { waiting, stable, drifting, blowUp, solverFailed, refused };
/// "stable", "drifting", "blow-up", "solver-failed", "refused"; empty for waiting.
std::string_view name(StabilityClass c);

/// A number of the scene that varies: --x POINTER=FROM:TO:N[:log].
struct VariedNumber {
    std::string pointer;
    double from = 0, to = 0;
    int count = 1;
    bool isLog = false;
    std::vector<double> values() const;
    bool operator==(const VariedNumber&) const = default;
};
/// Throws InvalidScene (pointer `option`) where the text is not an axis.
VariedNumber parseAxis(const std::string& text, const std::string& option);
/// The text that it is parsed from.
std::string textOf(const VariedNumber& axis);
/// Throws InvalidScene (pointer `option`) where its pointer is not a number of the scene: an error of the
/// option, and not of every point.
void requireNumber(const Scene& scene, const VariedNumber& number, const char* option);

struct StabilityResult {
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    StabilityClass kind = StabilityClass::waiting;
    double growth = unknown, maxEnergyError = unknown, failedAt = unknown;
    Outcome cause = Outcome::converged;
    /// By the energy error over the energies of the motion, as in the study of extremes: right up to 0.1. Of
    /// a motion without a conserved energy a run that is done is not judged.
    Judgement judgement = Judgement::unknown;
    std::string reason;  ///< of a refused point, in words; not exported
    bool isBounded() const { return kind == StabilityClass::stable || kind == StabilityClass::drifting; }
};

/// One scheme (index in the scene) with the numbers at the pointers changed. Refused where that makes no
/// valid scene; waiting where it was stopped.
StabilityResult runStability(const Scene& scene, std::size_t scheme,
                             const std::vector<std::pair<std::string, double>>& changes,
                             const std::stop_token& stop);

/// CPU seconds that it should take.
double secondsOfStability(const Scene& scene, std::size_t scheme,
                          const std::vector<std::pair<std::string, double>>& changes,
                          const std::stop_token& stop);

struct StabilityLimit {
    double limit = StabilityResult::unknown, low = limit, high = limit;  ///< stable up to low, not at high
};
/// Along x, the other changes given. Unknown where every value of the axis is stable, or none.
StabilityLimit findLimit(const Scene& scene, std::size_t scheme, const VariedNumber& x,
                         const std::vector<std::pair<std::string, double>>& changes,
                         const std::stop_token& stop);

}  // namespace extremal
