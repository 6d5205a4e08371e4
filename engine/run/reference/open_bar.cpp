// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/reference/open_bar.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "engine/core/text/text.hpp"
#include "engine/integrator/switch_values.hpp"
#include "engine/run/reference/error_floor.hpp"
#include "engine/scene/outlook/companion.hpp"

namespace extremal {

void judgeBar(SchemeResult& result, const System& system, const State& initial) {
    constexpr double open = 0.05;
    const Trajectory& rows = result.trajectory;
    const Column* error = rows.find("error");
    if (!error || rows.rows() == 0) return;
    double scale = errorMeasure(system, initial).scale;
    if (const auto d = static_cast<std::size_t>(system.dimension()); d > 0) {
        double sum = 0;
        for (std::size_t i = 0; i < d; ++i)
            for (const double q : rows.columns[1 + i].values) sum += q * q;
        scale = std::sqrt(sum / static_cast<double>(rows.rows()));
    }
    const std::vector<double>& t = rows.columns.front().values;
    if (const double turned = result.scheme ? unresolvedTurn(*result.scheme, system, initial) : 0;
        turned > 0) {
        result.summary.opensAt = t.front();
        result.summary.caution = "the error bar is open from the start: a step is " +
                                 formatNumber(turned, 2) +
                                 " rad of the fastest motion, which neither the scheme nor its companion "
                                 "needs to follow";
        return;
    }
    for (std::size_t r = 0; r < t.size(); ++r) {
        if (error->values[r] <= open * scale) continue;
        result.summary.opensAt = t[r];
        result.summary.caution =
            "the error bar is open from t = " + formatNumber(t[r], 3) +
            " on: the difference from the companion is above 0.05 of the size of the state";
        return;
    }
}

namespace {

/// Whether the rate x' jumps on the straight line between two rows. Along the half with the larger change of
/// the rate, the change halves with the length where the rate is smooth, and stays where it jumps.
class Jumps {
public:
    Jumps(const System& system, std::size_t width)
        : system_(system), from_(width), to_(width), middle_(width), x_(width) {}

    bool isBetween(double t0, const std::vector<double>& x0, double t1, const std::vector<double>& x1) {
        constexpr int pieces = 4;
        for (int k = 0; k < pieces; ++k)
            if (isIn(t0, x0, t1, x1, double(k) / pieces, double(k + 1) / pieces)) return true;
        return false;
    }

private:
    bool rateAt(double t0, const std::vector<double>& x0, double t1, const std::vector<double>& x1, double s,
                std::vector<double>& rate) {
        for (std::size_t i = 0; i < x_.size(); ++i) x_[i] = x0[i] + s * (x1[i] - x0[i]);
        return rateOf(system_, t0 + s * (t1 - t0), x_.data(), rate.data());
    }
    static double sizeOf(const std::vector<double>& a) {
        double size = 0;
        for (const double v : a) size = std::max(size, std::abs(v));
        return size;
    }
    static double distance(const std::vector<double>& a, const std::vector<double>& b) {
        double sum = 0;
        for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
        return std::sqrt(sum);
    }
    bool isIn(double t0, const std::vector<double>& x0, double t1, const std::vector<double>& x1, double a,
              double b) {
        constexpr int halvings = 26, few = 10;
        if (!rateAt(t0, x0, t1, x1, a, from_) || !rateAt(t0, x0, t1, x1, b, to_)) return false;
        const double size = std::max(sizeOf(from_), sizeOf(to_)), whole = distance(from_, to_);
        if (!(whole > 1e-9 * size)) return false;
        double change = whole;
        for (int i = 1; i <= halvings; ++i) {
            const double middle = (a + b) / 2;
            if (!rateAt(t0, x0, t1, x1, middle, middle_)) return false;
            const double left = distance(from_, middle_), right = distance(middle_, to_);
            change = std::max(left, right);
            (left > right ? b : a) = middle;
            (left > right ? to_ : from_) = middle_;
            if (i == few && change < 0.02 * whole) return false;
        }
        // A line between distant rows may pass through a pole, beside which the motion is smooth.
        return change > 1e-3 * whole && std::max(sizeOf(from_), sizeOf(to_)) < 4 * size;
    }

    const System& system_;
    std::vector<double> from_, to_, middle_, x_;
};

/// Whether rows lie in other branches of a typed formula than those before them.
class Kinks {
public:
    explicit Kinks(const System& system) : system_(system) {
        const Mechanical* const mechanics = system.parts.find<Mechanical>();
        if (!mechanics) return;
        if (auto branches = typed::branchesOf(*mechanics)) values_.emplace(std::move(branches));
    }
    bool isPassed(double t, const std::vector<double>& x) {
        if (!values_) return false;
        typed::Branches::Cells cells = values_->cells(t, x.data(), system_.mechanics());
        const bool isOther = !last_.empty() && cells != last_;
        last_ = std::move(cells);
        return isOther;
    }

private:
    const System& system_;
    std::optional<SwitchValues> values_;
    typed::Branches::Cells last_;
};

}  // namespace

void judgeAgreement(SchemeResult& result, const System& system, const State& initial,
                    const ExactSolution& second, double factor, const std::stop_token& stop) {
    constexpr double most = 0.5;
    const Trajectory& rows = result.trajectory;
    const Column* const error = rows.find("error");
    const std::size_t width = initial.x.size();
    if (!error || rows.columns.size() <= width) return;
    const ErrorMeasure measure = errorMeasure(system, initial);
    if (!measure.evaluate) return;
    Summary& summary = result.summary;
    // Of the scheme and of a companion with twice its steps.
    const double size = std::max(measure.scale, largestEntry(initial));
    double floor = roundOffFloor(size, 3 * summary.steps);
    // Below its tolerance an error-controlled code promises nothing: its first steps err by much less.
    if (result.spec.tolerance) floor = std::max(floor, *result.spec.tolerance * size);
    std::vector<double> x(width), other(width), values(measure.columns.size());
    const std::vector<double>& t = rows.columns.front().values;
    double largest = floor;
    Jumps jumps(system, width);
    Kinks kinks(system);
    // Over a kink of the force a step has the order 2, and so has its companion. Error controls end there.
    const bool losesOrder = result.scheme && !result.scheme->isAdaptive() && result.scheme->claims.order > 2;
    std::vector<double> before(width);
    for (std::size_t r = 0; r < t.size() && !stop.stop_requested(); ++r) {
        if (summary.opensAt <= t[r]) return;
        x.swap(before);
        for (std::size_t i = 0; i < width; ++i) x[i] = rows.columns[1 + i].values[r];
        if (r > 0 && jumps.isBetween(t[r - 1], before, t[r], x)) {
            summary.opensAt = t[r];
            summary.caution = "the error bar is open from t = " + formatNumber(t[r], 3) +
                              " on: the forces jump there, and what a step over a jump errs by depends on "
                              "where it falls in the step, for the companion as well";
            return;
        }
        if (losesOrder && kinks.isPassed(t[r], x)) {
            summary.opensAt = t[r];
            summary.caution = "the error bar is open from t = " + formatNumber(t[r], 3) +
                              " on: the formula has a kink there, over which the scheme and its companion "
                              "lose their orders";
            return;
        }
        if (!second) continue;
        second(t[r], other);
        measure.evaluate(x.data(), other.data(), values.data());
        const double own = error->values[r], its = factor * values[0];
        largest = std::max({largest, own, its});
        if (std::abs(own - its) <= most * largest) continue;
        if (!std::isfinite(own) || !std::isfinite(its)) continue;
        summary.opensAt = t[r];
        summary.caution = "the error bar is open from t = " + formatNumber(t[r], 3) +
                          " on: two companions disagree, one says " + formatNumber(own, 2) +
                          " and the other " + formatNumber(its, 2);
        return;
    }
}

void judgeCompanion(SchemeResult& result, const Reference& reference, const std::string& reason) {
    constexpr double most = 0.02;
    Summary& summary = result.summary;
    if (!reason.empty()) summary.caution = "there is no error bar: it " + reason;
    if (!reference.counts || reference.counts->steps == 0 || summary.steps == 0) return;
    if (static_cast<double>(reference.counts->events) <= most * static_cast<double>(reference.counts->steps))
        return;
    if (result.trajectory.rows() > 0) summary.opensAt = result.trajectory.columns.front().values.front();
    summary.caution =
        "the error bar is open from the start: " + std::to_string(reference.counts->events) + " of " +
        std::to_string(reference.counts->steps) +
        " steps of its companion had no root of the energy equation or did more than go on, and the "
        "difference may be the error of the companion";
}

}  // namespace extremal
