// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/stability/stability.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/algebra/line_fit.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/run/march/march.hpp"
#include "engine/run/march/march_grid.hpp"
#include "engine/run/march/motion_check.hpp"
#include "engine/scene/outlook/two_positions.hpp"
#include "engine/scene/read/overrides.hpp"
#include "engine/scene/single_scheme.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/expected_time.hpp"
#include "engine/study/stability/values_between.hpp"

namespace extremal {
namespace {

constexpr double blowUp = 1e6;

double sizeOf(const double* x, std::size_t n) {
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) sum += x[i] * x[i];
    if (isSafeSquare(sum)) return std::sqrt(sum);
    return scaledDistance(n, x, std::vector<double>(n).data());
}

/// The line through the energy errors.
class EnergyLine {
public:
    void add(double t, double e) {
        line_.add(t, e);
        largest = std::max(largest, std::abs(e));
    }
    /// Whether it rises by more than the scatter about it, and by more than round-off of `scale`.
    bool drifts(double duration, double scale) const {
        if (line_.points() < 8 || !std::isfinite(line_.slope())) return false;
        const double rise = std::abs(line_.slope()) * duration;
        return rise > 2 * line_.scatter() && rise > 1e-12 * scale;
    }
    double largest = 0;

private:
    RunningLine line_;
};

/// The scene with this scheme alone, and nothing to show.
Value documentOf(const Scene& scene, std::size_t scheme,
                 const std::vector<std::pair<std::string, double>>& changes, std::vector<Problem>& errors) {
    Value document = toValue(scene);
    std::vector<Change> changed;
    for (const auto& [pointer, value] : changes) applyOverride(document, {pointer, value}, changed, errors);
    keepAlone(document, scheme);
    // To see where a scheme fails is what this is for.
    document.find("schemes")->asArray().front().set("allow_unstable", true);
    document.set("reference", "none");
    std::erase_if(document.asObject(), [](const Value::Member& m) { return m.first == "output"; });
    return document;
}

ReadScene readChanged(const Scene& scene, std::size_t scheme,
                      const std::vector<std::pair<std::string, double>>& changes) {
    std::vector<Problem> errors;
    const Value document = documentOf(scene, scheme, changes, errors);
    if (errors.empty()) return readScene(document);
    ReadScene refused;
    refused.errors = std::move(errors);
    return refused;
}

StabilityResult refused(std::string reason) {
    StabilityResult r;
    r.kind = StabilityClass::refused;
    r.cause = Outcome::refused;
    r.judgement = Judgement::refused;
    r.reason = std::move(reason);
    return r;
}

/// `scale`: the energies of the motion; 0 where none is conserved.
Judgement judgementOf(const StabilityResult& r, double scale) {
    constexpr double right = 0.1;
    if (r.kind == StabilityClass::blowUp && r.cause != Outcome::notFinite) return Judgement::lost;
    if (!r.isBounded()) return judge(RunStatus::failed, r.cause, {});
    JudgedValue energy{r.maxEnergyError, right * scale, scale, 0};
    if (!(scale > 0)) energy.value = StabilityResult::unknown;
    return judge(RunStatus::done, Outcome::converged, {&energy, 1});
}

StabilityResult runResolved(const ResolvedScene& scene, const std::stop_token& stop) {
    const ResolvedScheme& scheme = scene.schemes.front();
    const double step = scheme.spec.step.value;
    const State start = schemeStart(scene, scheme, step);
    const System& system = *systemOf(scene, scheme);
    const auto integrator = scheme.make(system, step, start);
    const EnergyFunction energy = energyOf(system);
    const std::size_t size = start.x.size();
    const double first = energy ? energy(start.t, start.x.data()) : 0, norm = sizeOf(start.x.data(), size);
    EnergyLine line;
    MotionCheck motion(system, start, step, true);
    bool isLarge = false, isOut = false;
    double last = norm, lastTime = start.t, leftAt = start.t;
    const MarchSink look{[&](const Stretch& stretch) {
        for (std::size_t i = 0; i < stretch.nodes.size() && !isLarge && !motion.hasLeftDomain(); ++i) {
            last = sizeOf(stretch.nodes.x(i), size);
            lastTime = stretch.nodes.t(i);
            isLarge = norm > 0 && last > blowUp * norm;
            const double H = energy ? energy(lastTime, stretch.nodes.x(i)) : 0;
            // Near a limit of stability energies go far, and come back; a motion that was left does not, and
            // neither does one beyond the edge of where the Lagrangian is defined.
            if (isOut || !std::isfinite(H) || motion.looksAt(stretch.nodes.node(i))) {
                const bool wasOut = isOut;
                isOut = !motion.isSound(lastTime, stretch.nodes.x(i));
                if (isOut && !wasOut) leftAt = lastTime;
            }
            if (energy && std::isfinite(H)) {
                line.add(lastTime, H - first);
                motion.noteEnergy(lastTime, H);
            }
        }
        return !isLarge && !motion.hasLeftDomain();
    }};
    State state = start;
    const MarchGrid grid = marchGrid(scene.scene, scheme, step);
    const MarchReport report = march(*integrator, state, grid, {&look, 1}, stop);
    StabilityResult r;
    if (report.outcome == Outcome::stopped) return r;
    const double duration = lastTime - start.t;
    if (duration > 0 && norm > 0 && last > 0) r.growth = std::log(last / norm) / duration;
    if (energy) r.maxEnergyError = line.largest;
    r.cause = report.outcome;
    const bool isLost = report.outcome == Outcome::converged && (isOut || motion.hasGained());
    if (isLost) r.cause = isOut ? motion.outcome() : Outcome::lost;
    if (isLarge || isLost || report.outcome == Outcome::notFinite)
        r.kind = StabilityClass::blowUp;
    else if (report.outcome != Outcome::converged)
        r.kind = StabilityClass::solverFailed;
    else
        r.kind = line.drifts(duration, std::abs(first)) ? StabilityClass::drifting : StabilityClass::stable;
    if (!r.isBounded()) r.failedAt = isLost && isOut && !isLarge ? leftAt : lastTime;
    r.judgement = judgementOf(r, motion.scale());
    return r;
}

double number(const std::string& text, const std::string& option, const std::string& all) {
    const auto value = parseNumber(text);
    if (!value || !std::isfinite(*value))
        throw InvalidScene(option, "must be POINTER=FROM:TO:N[:log], got \"" + all + "\"",
                           "for example /model/k=1:1e4:20:log");
    return *value;
}

}  // namespace

std::string_view name(StabilityClass c) {
    switch (c) {
        case StabilityClass::stable:
            return "stable";
        case StabilityClass::drifting:
            return "drifting";
        case StabilityClass::blowUp:
            return "blow-up";
        case StabilityClass::solverFailed:
            return "solver-failed";
        case StabilityClass::refused:
            return "refused";
        case StabilityClass::waiting:
            break;
    }
    return "";
}

std::vector<double> VariedNumber::values() const { return valuesBetween(from, to, count, isLog); }

VariedNumber parseAxis(const std::string& text, const std::string& option) {
    const std::size_t equals = text.find('=');
    std::vector<std::string> parts(1);
    for (const char c : equals == std::string::npos ? std::string() : text.substr(equals + 1))
        if (c == ':')
            parts.emplace_back();
        else
            parts.back() += c;
    const bool isLog = parts.size() == 4 && parts[3] == "log";
    if (equals == std::string::npos || parts.size() < 3 || parts.size() > 4 || (parts.size() == 4 && !isLog))
        (void)number("", option, text);
    VariedNumber axis{text.substr(0, equals), number(parts[0], option, text), number(parts[1], option, text),
                      0, isLog};
    const double count = number(parts[2], option, text);
    if (count < 2 || count > 10000 || count != std::floor(count))
        throw InvalidScene(option, "the number of values must be 2 to 10000, got " + parts[2]);
    axis.count = static_cast<int>(count);
    if (!(axis.from < axis.to) || (isLog && !(axis.from > 0)))
        throw InvalidScene(option, isLog ? "needs 0 < FROM < TO" : "needs FROM < TO");
    return axis;
}

std::string textOf(const VariedNumber& axis) {
    return axis.pointer + '=' + formatNumber(axis.from) + ':' + formatNumber(axis.to) + ':' +
           std::to_string(axis.count) + (axis.isLog ? ":log" : "");
}

void requireNumber(const Scene& scene, const VariedNumber& number, const char* option) {
    const ReadScene read = readScene(toValue(scene), {{number.pointer, number.from}});
    for (const Problem& p : read.errors)
        if (!p.origin.empty()) throw InvalidScene(option, number.pointer + " " + p.message, p.hint);
}

StabilityResult runStability(const Scene& scene, std::size_t scheme,
                             const std::vector<std::pair<std::string, double>>& changes,
                             const std::stop_token& stop) {
    const ReadScene read = readChanged(scene, scheme, changes);
    if (!read.resolved)
        return refused(read.errors.empty() ? ""
                                           : read.errors.front().pointer + " " + read.errors.front().message);
    try {
        return runResolved(*read.resolved, stop);
    } catch (const InvalidScene& e) {
        return refused(e.problems().front().message);
    }
}

double secondsOfStability(const Scene& scene, std::size_t scheme,
                          const std::vector<std::pair<std::string, double>>& changes,
                          const std::stop_token& stop) {
    return secondsOfScene([&] { return readChanged(scene, scheme, changes); }, stop);
}

StabilityLimit findLimit(const Scene& scene, std::size_t scheme, const VariedNumber& x,
                         const std::vector<std::pair<std::string, double>>& changes,
                         const std::stop_token& stop) {
    const auto isBounded = [&](double value) {
        auto all = changes;
        all.emplace_back(x.pointer, value);
        return runStability(scene, scheme, all, stop).isBounded();
    };
    StabilityLimit found;
    std::optional<double> low, high;
    for (const double value : x.values()) {
        if (stop.stop_requested()) return found;
        if (isBounded(value)) {
            low = value;
        } else if (low) {
            high = value;
            break;
        }
    }
    if (!low || !high) return found;
    while (*high - *low > 0.5e-4 * std::abs(*high) && !stop.stop_requested()) {
        const double middle = (*low + *high) / 2;
        (isBounded(middle) ? low : high) = middle;
    }
    found.low = *low;
    found.high = *high;
    found.limit = (*low + *high) / 2;
    return found;
}

}  // namespace extremal
