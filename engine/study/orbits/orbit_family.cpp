// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/orbits/orbit_family.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/scene/read/pointer.hpp"
#include "engine/scene/write/codec.hpp"

namespace extremal {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

constexpr int mostCorrections = 20, mostShorter = 10;
/// From one orbit to the next, over the sizes of the first.
constexpr double mostChange = 0.4;

/// A place on the curve: an orbit and the number.
struct Place {
    OrbitGuess guess;
    double value = 0;
};

/// The equations at any value of the number.
class Along {
public:
    Along(const ResolvedScene& scene, std::size_t scheme, OrbitEquations& first, const OrbitPath& path,
          const PeriodicOrbit& orbit)
        : document_(toValue(scene.scene)),
          scheme_(scheme),
          first_(first),
          path_(path),
          energy_(orbit.energy),
          start_(valueOf(orbit)),
          range_(path.to - start_) {
        if (range_ == 0)
            throw InvalidScene("--follow", path.name + " is " + formatNumber(start_) + " already",
                               "another value to go to");
    }

    double start() const { return start_; }
    double range() const { return range_; }
    /// Whether a value is beyond the one to go to.
    bool isReached(double value) const { return (value - path_.to) * range_ >= 0; }
    bool isBefore(double value) const { return (value - start_) * range_ < -1e-9 * range_ * range_; }

    /// Gives up equations of values that are passed; references to them end.
    void forget() {
        constexpr std::size_t most = 64;
        if (known_.size() > most) known_.clear();
    }
    /// Those of the value, measured as the first ones, with their phase condition at a guess, whose period is
    /// made theirs where it is given.
    OrbitEquations& at(double value, const OrbitGuess& reference, OrbitGuess& guess) {
        OrbitEquations& equations = found(value);
        equations.measureAs(first_, reference);
        if (path_.name == "period")
            guess.period = value;
        else if (first_.kind() == OrbitKind::forced)
            guess.period = periods_.at(value);
        return equations;
    }

private:
    bool isOwn() const { return path_.name == "energy" || path_.name == "period"; }
    /// Its value for an orbit of the first scene.
    double valueOf(const PeriodicOrbit& orbit) {
        if (path_.name == "energy" && first_.kind() != OrbitKind::conservative)
            throw InvalidScene("--follow", "no energy is kept: there is no family along it",
                               "a number of the scene: /model/...=VALUE");
        if (path_.name == "period" && first_.kind() != OrbitKind::conservative)
            throw InvalidScene("--follow", "the period is not free: there is no family along it",
                               "a number of the scene: /model/...=VALUE");
        if (path_.name == "energy") return orbit.energy;
        if (path_.name == "period") return orbit.period;
        periods_[0] = orbit.period;
        const Value* const number = valueAt(document_, path_.name);
        if (!number || !number->isNumber())
            throw InvalidScene(
                "--follow",
                path_.name + (number ? " is not a plain number of the scene" : " is not in the scene"),
                "energy, period, or a pointer to a number: /model/k=2");
        return number->asNumber();
    }
    OrbitEquations& found(double value) {
        if (path_.name == "energy") first_.hold(OrbitHold::energy, value);
        if (path_.name == "period") first_.hold(OrbitHold::period, value);
        if (isOwn()) return first_;
        auto& known = known_[value];
        if (known) return *known;
        const ReadScene read = readScene(document_, {{path_.name, value}});
        if (!read.resolved)
            throw InvalidScene("--follow",
                               path_.name + "=" + formatNumber(value) + " " + read.errors.front().message,
                               read.errors.front().hint);
        auto& made = known_[value];
        made = std::make_unique<OrbitEquations>(read.resolved, scheme_, first_.steps());
        made->hold(first_.held(), energy_);
        periods_[value] = path_.periodOf ? path_.periodOf(*read.resolved) : 0;
        return *made;
    }

    Value document_;
    std::size_t scheme_;
    OrbitEquations& first_;
    const OrbitPath& path_;
    double energy_;
    std::map<double, std::unique_ptr<OrbitEquations>> known_;
    std::map<double, double> periods_;
    double start_, range_;
};

/// Newton's method for a place on the curve, along which the direction (y_t, s_t) leads.
class Corrector {
public:
    explicit Corrector(Along& along) : along_(along) {}

    /// Moves the place from its prediction onto the curve; the orbit there, or nothing with a problem.
    std::optional<PeriodicOrbit> solve(Place& place, const Vector& direction) {
        try {
            return iterate(place, direction);
        } catch (const InvalidScene& e) {  // a value on the way that the scene does not take
            problem_ = e.problems().front().message;
            return {};
        }
    }
    const std::string& problem() const { return problem_; }

private:
    std::optional<PeriodicOrbit> iterate(Place& place, const Vector& direction) {
        const Place prediction = place;
        std::vector<double> closes;
        OrbitEquations::Residual residual;
        double before = HUGE_VAL;
        for (int iteration = 0; iteration < mostCorrections; ++iteration) {
            OrbitEquations& equations = along_.at(place.value, prediction.guess, place.guess);
            const Outcome outcome = equations.evaluate(place.guess, residual, true);
            if (outcome != Outcome::converged) return fail(equations, outcome);
            closes.push_back(residual.gap);
            const double norm = residual.value.norm();
            if (norm < closedGap && (norm < 1e-14 || norm > before / 4)) {
                return equations.orbitAt(place.guess, residual, std::move(closes));
            }
            if (!(norm < 1e3 * std::max(before, 1.0))) break;
            before = norm;
            const Vector by = correction(equations, place, prediction, direction, residual);
            if (!(std::abs(by(by.size() - 1)) < 1)) break;  // farther than the whole way
            place.guess = equations.moved(place.guess, by.head(by.size() - 1));
            place.value += by(by.size() - 1) * along_.range();
        }
        problem_ = "Newton's method does not converge";
        return {};
    }
    std::optional<PeriodicOrbit> fail(const OrbitEquations& equations, Outcome outcome) {
        problem_ = "a step at t = " + formatNumber(equations.failedAt(), 4) +
                   " fails: " + std::string(name(outcome));
        return {};
    }
    /// Of the unknowns and of the number, each over its size.
    Vector correction(OrbitEquations& equations, const Place& place, const Place& prediction,
                      const Vector& direction, const OrbitEquations::Residual& residual) {
        const Eigen::Index rows = residual.value.size(), n = equations.unknowns();
        Matrix J = Matrix::Zero(rows + 1, n + 1);
        J.topLeftCorner(rows, n) = residual.derivative;
        J.col(n).head(rows) = byNumber(place, prediction);
        J.row(rows) = direction.transpose();
        Vector r(rows + 1);
        r.head(rows) = residual.value;
        r(rows) = direction.head(n).dot(equations.between(prediction.guess, place.guess)) +
                  direction(n) * (place.value - prediction.value) / along_.range();
        return leastCorrection(J, r);
    }
    /// d F / d s times the range, by differences; it is only the means of the iteration.
    Vector byNumber(const Place& place, const Place& prediction) {
        constexpr double part = 1e-5;
        OrbitEquations::Residual above, below;
        OrbitGuess guess = place.guess;
        const double shift = part * along_.range();
        const auto value = [&](double s, OrbitEquations::Residual& residual) {
            OrbitGuess there = guess;
            OrbitEquations& equations = along_.at(s, prediction.guess, there);
            return equations.evaluate(there, residual, false) == Outcome::converged;
        };
        const bool isKnown = value(place.value + shift, above) && value(place.value - shift, below);
        (void)along_.at(place.value, prediction.guess, guess);
        if (!isKnown) return Vector::Zero(above.value.size());
        return (above.value - below.value) / (2 * part);
    }

    Along& along_;
    std::string problem_;
};

std::size_t outside(const PeriodicOrbit& orbit) {
    return static_cast<std::size_t>(
        std::count_if(orbit.multipliers.begin(), orbit.multipliers.end(),
                      [](const auto& each) { return std::abs(each) > 1 + 1e-4; }));
}

/// What the multipliers of two neighbours say of what is between them.
std::string markBetween(const PeriodicOrbit& before, const PeriodicOrbit& after) {
    const std::size_t left = outside(before), right = outside(after);
    if (left == right) return {};
    const PeriodicOrbit& wild = left > right ? before : after;
    // Of those outside, the one nearest to the circle has crossed it.
    const std::complex<double> crossed = wild.multipliers[std::max(left, right) - 1];
    if (std::abs(crossed.imag()) > 1e-3) return "pair leaves the circle";
    return crossed.real() < 0 ? "period doubling" : "multiplier at 1";
}

/// The way along the curve from the first orbit.
class FamilyWalk {
public:
    FamilyWalk(Along& along, OrbitEquations& first, const OrbitPath& path, const PeriodicOrbit& orbit)
        : along_(along), corrector_(along), first_(first), path_(path), last_{guessOf(orbit), along.start()} {
        family_.rows.push_back({along.start(), orbit, first.stabilityOf(orbit), {}});
        OrbitGuess there = last_.guess;
        n_ = along.at(last_.value, last_.guess, there).unknowns();
        direction_ = alongNumber();
        length_ = whole_ = 1.0 / std::max(1, path.points - 1);
    }

    OrbitFamily walk(const std::stop_token& stop) {
        const std::size_t most = 5 * static_cast<std::size_t>(std::max(path_.points, 2));
        while (family_.rows.size() < most) {
            family_.isStopped = stop.stop_requested();
            if (family_.isStopped || !isGoingOn()) return std::move(family_);
        }
        family_.end = "has not reached " + path_.name + " = " + formatNumber(path_.to) + " after " +
                      std::to_string(most) + " orbits: more --points";
        return std::move(family_);
    }

private:
    Vector alongNumber() const { return Vector::Unit(n_ + 1, n_); }

    /// One orbit further, or a shorter length; false at the end.
    bool isGoingOn() {
        along_.forget();
        Place next = predicted(length_);
        auto found = corrector_.solve(next, direction_);
        if (!found) {
            length_ /= 2;
            if (++shorter_ <= mostShorter) return true;
            return end("cannot be continued beyond " + path_.name + " = " + formatNumber(last_.value, 6) +
                       ": " + corrector_.problem());
        }
        shorter_ = 0;
        if (along_.isReached(next.value)) return arrive(next);
        const Vector chord = chordTo(next);
        const bool isEasy = found->closes.size() <= 6;
        accept(next, std::move(*found));
        const double size = chord.norm();
        direction_ = chord / size;
        // As far as the number may go between two of the wanted points, and as orbits may change.
        const double number = std::max(std::abs(direction_(n_)), 1e-12);
        length_ = std::min({isEasy ? 1.5 * size : size, 2 * whole_ / number, mostChange});
        last_ = std::move(next);
        if (!along_.isBefore(last_.value)) return true;
        return end("turns round and comes back to " + path_.name + " = " + formatNumber(along_.start(), 6));
    }
    bool end(std::string why) {
        family_.end = std::move(why);
        return false;
    }
    /// The wanted value itself, from a place in proportion.
    bool arrive(const Place& beyond) {
        const double part = (path_.to - last_.value) / (beyond.value - last_.value);
        Place place = predicted(length_ * std::min(part, 1.0));
        place.value = path_.to;
        if (auto found = corrector_.solve(place, alongNumber())) {
            accept(place, std::move(*found));
            return false;
        }
        return end("does not reach " + path_.name + " = " + formatNumber(path_.to) + ": " +
                   corrector_.problem());
    }
    Place predicted(double by) {
        OrbitGuess guess = last_.guess;
        OrbitEquations& here = along_.at(last_.value, last_.guess, guess);
        return {here.moved(guess, by * direction_.head(n_)),
                last_.value + by * direction_(n_) * along_.range()};
    }
    Vector chordTo(const Place& next) {
        OrbitGuess from = last_.guess;
        OrbitEquations& here = along_.at(last_.value, last_.guess, from);
        Vector chord(n_ + 1);
        chord.head(n_) = here.between(from, next.guess);
        chord(n_) = (next.value - last_.value) / along_.range();
        return chord;
    }
    void accept(const Place& place, PeriodicOrbit found) {
        const std::size_t rows = family_.rows.size();
        const double before = rows > 1 ? last_.value - family_.rows[rows - 2].value : 0;
        std::string mark = (place.value - last_.value) * before < 0
                               ? "turns"
                               : markBetween(family_.rows.back().orbit, found);
        const OrbitStability stability = first_.stabilityOf(found);
        family_.rows.push_back({place.value, std::move(found), stability, std::move(mark)});
    }

    Along& along_;
    Corrector corrector_;
    OrbitEquations& first_;
    const OrbitPath& path_;
    OrbitFamily family_;
    Place last_;
    Eigen::Index n_ = 0;  ///< unknowns of one orbit
    Vector direction_;    ///< of the unknowns, then of the number
    double length_ = 0, whole_ = 0;
    int shorter_ = 0;  ///< how often the length was halved since the last orbit
};

}  // namespace

OrbitFamily followFamily(const ResolvedScene& scene, std::size_t scheme, OrbitEquations& first,
                         const PeriodicOrbit& orbit, const OrbitPath& path, const std::stop_token& stop) {
    Along along(scene, scheme, first, path, orbit);
    return FamilyWalk(along, first, path, orbit).walk(stop);
}

}  // namespace extremal
