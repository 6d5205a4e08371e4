// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/laws/claims.hpp"

#include <QtGlobal>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/baseline/parts.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/mechanism/mechanism_start.hpp"
#include "engine/model/first_order/one_form.hpp"
#include "engine/model/parts/constraint.hpp"
#include "engine/model/spins/spins.hpp"
#include "engine/model/wave/hamiltonian.hpp"
#include "engine/observe/catalog.hpp"
#include "tests/laws/bodies.hpp"
#include "tests/laws/form_defects.hpp"
#include "tests/tools/jacobian.hpp"

namespace extremal::laws {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
/// Orders are whole numbers: a slope that rounds to another one is another order.
constexpr double half = 0.5;
/// What laws allow, of round-off and of differences in place of derivatives. Measured where it is claimed:
/// return 2.6e-10 (spline 2 x gauss), symplectic 8e-9 (oscillatory 3 x filon-lobatto), on wave functions
/// 4e-13, change of what is conserved 5.7e-12 (energy, yoshida of spectral-collocation 3 roots).
constexpr double returned = 1e-9, symplectic = 5e-8, unitary = 1e-11, conserved = 3e-11;

/// The largest error of so many steps, a multiple of 4, at the quarters of the time, or of one or two at its
/// end; infinite where a step has no solution.
double errorOf(const Trial& trial, long long steps) {
    const Subject& on = trial.on;
    const auto integrator = trial.make(on.time / static_cast<double>(steps));
    State state = on.start;
    double worst = 0;
    for (const State& exact : std::span(on.exact).last(steps < 4 ? 1 : 4)) {
        for (long long k = steps < 4 ? steps : steps / 4; k > 0; --k) {
            const StepReport report = advance(*integrator, state);
            // A step that started something anew has an order of its own.
            if (report.outcome != Outcome::converged || report.event != StepEvent::none)
                return std::numeric_limits<double>::infinity();
        }
        const bool isFree = integrator->grid() == TimeGrid::free;
        worst = std::max(worst, distanceOn(on, state, isFree ? on.exactAt(state.t) : exact));
    }
    return worst;
}

/// In coordinates: M^T J M - J for the derivative M of one step by central differences of order 6. Every
/// coordinate is measured in its own size, every entry (i, j) in the root of the actions of i and j. With
/// constraints on their manifold: displaced states are put back on it.
double canonicalDefect(const Trial& trial, double each) {
    const Subject& on = trial.on;
    const std::size_t d = on.half();
    std::vector<double> action(d);
    for (std::size_t i = 0; i < d; ++i) action[i] = on.own[i] * on.own[i + d];
    const auto integrator = trial.make(on.time / each);
    const auto step = [&](State from) {
        integrator->begin(from);
        return after(*integrator, from, 1);
    };
    if (!on.system.parts.find<Constraint>()) {
        const auto M = jacobianOf(step, on.start, 5e-4, on.own);
        return M ? symplecticDefect(*M, action) : unknown;
    }
    const auto onManifold = [&](State from) -> std::optional<State> {
        putOnConstraints(on.system, from, true);
        return from;
    };
    const auto B = jacobianOf(onManifold, on.start, 5e-4, on.own),
               M = jacobianOf([&](const State&from) { return step(*onManifold(from)); }, on.start, 5e-4,
                              on.own);
    return B && M ? symplecticDefect(*M, action, &*B) : unknown;
}

/// How far a step moves <a, b>, whose imaginary part is the symplectic form and whose real part the metric.
double innerProductDefect(const Trial& trial, double each) {
    const Subject& on = trial.on;
    const int n = static_cast<int>(on.start.x.size() / 2);
    const auto inner = [n](const State& a, const State& b) {
        return innerProduct(coefficients(a.x.data()), coefficients(b.x.data()), n);
    };
    const auto integrator = trial.make(on.time / each);
    State a = on.start, b = on.exact[1];
    b.t = a.t;
    b.node = a.node;
    const Complex before = inner(a, b);
    for (State* s : {&a, &b}) {
        integrator->begin(*s);
        if (advance(*integrator, *s).outcome != Outcome::converged) return unknown;
    }
    return std::abs(inner(a, b) - before);
}

bool isQuadratic(const EnergyFunction& energy, const State& at) {
    std::vector<double> twice = at.x;
    for (double& x : twice) x *= 2;
    const double E = energy(at.t, at.x.data());
    return std::abs(energy(at.t, twice.data()) - 4 * E) < 1e-13 * std::abs(E);
}

using Invariant = std::function<double(const State&)>;

std::vector<Invariant> momentaOf(const Subject& on) {
    std::vector<Invariant> all;
    const std::size_t p = on.system.hasCoordinates() ? on.half() : 0;
    const double size = on.system.parts.find<Body>() ? 1 : std::max(1.0, on.scaleQ) * on.scaleP;
    for (const MomentumMap& map : on.system.momenta)
        all.push_back([=](const State& s) { return map.value(s.x.data(), s.x.data() + p) / size; });
    return all;
}

/// What a subject knows of that name, each in its own size.
std::vector<Invariant> invariantsOf(const Subject& on, const std::string& what) {
    if (what == "momentum") return momentaOf(on);
    const EnergyFunction energy = energyOf(on.system);
    // On the way as well: at a start with many zeros other functions pass for quadratic ones.
    const bool isEnergy = what == "energy",
               isHere = energy &&
                        (isEnergy || (isQuadratic(energy, on.start) && isQuadratic(energy, on.exact[1])));
    if (!isHere) return {};
    const double size = std::max(std::abs(energy(on.start.t, on.start.x.data())), 1e-3);
    return {[=](const State& s) { return energy(s.t, s.x.data()) / size; }};
}

/// Follows what is conserved, by the system's own functions or by the observable of that name.
/// Whether the Hamiltonian is a polynomial of degree four at most.
bool isQuartic(const Subject& on) {
    const auto known = {"harmonic-oscillator", "henon-heiles", "duffing", "double-well"};
    return std::find(known.begin(), known.end(), on.name) != known.end();
}

class Watch {
public:
    Watch(const Trial& trial, std::string what, double step, const Integrator& integrator) {
        const Subject& on = trial.on;
        if (what == "quartic energy") {
            if (!isQuartic(on)) return;
            what = "energy";
        }
        const auto condition = what.find(" if H is constant");
        // Sums of spins are measured, and have no function of their own.
        const bool isKnown = (what == "momentum" && !on.system.parts.find<Spins>()) || what == "energy" ||
                             what == "quadratic invariants";
        if (!on.isAutonomous && (condition != std::string::npos || (isKnown && what != "momentum"))) return;
        if (condition != std::string::npos) what.erase(condition);
        if (isKnown) {
            invariants_ = invariantsOf(on, what);
            for (const Invariant& i : invariants_) first_.push_back(i(on.start));
            return;
        }
        std::replace(what.begin(), what.end(), ' ', '-');
        const ObservableEntry* const entry = findObservable(what);
        if (!entry || !entry->bind || entry->needsReference || !appliesTo(*entry, on.system)) return;
        observer_ = entry->bind({on.system, on.start, {}, trial.pair, step, integrator.quantities()});
        if (observer_->extreme < 0) observer_.reset();
    }
    bool sees() const { return !invariants_.empty() || observer_; }

    /// The largest change so far, at a node.
    double at(const State& state, const StepReport& report, const Integrator& integrator, bool isFirst) {
        for (std::size_t i = 0; i < invariants_.size(); ++i)
            worst_ = std::max(worst_, std::abs(invariants_[i](state) - first_[i]));
        if (!observer_) return worst_;
        NodeBlock node(state.x.size(), 1, integrator.quantities().size());
        node.push(state, report);
        if (double* values = node.lastQuantities()) {
            std::fill_n(values, integrator.quantities().size(), unknown);
            if (!isFirst) integrator.measure(state, values);
        }
        std::vector<double> values(observer_->columns.size());
        observer_->evaluate(node, values.data(), values.size());
        if (std::isfinite(values[0]) && size_ == 0) size_ = std::max(std::abs(values[0]), 1e-3);
        const double change = values[static_cast<std::size_t>(observer_->extreme)];
        if (std::isfinite(change)) worst_ = std::max(worst_, std::abs(change) / size_);
        return worst_;
    }
    /// An observable that has had no value was not measured.
    bool hasSeen() const { return !observer_ || size_ > 0; }

private:
    std::vector<Invariant> invariants_;
    std::vector<double> first_;
    std::optional<Observer> observer_;
    double worst_ = 0, size_ = 0;
};

/// Not a number where the scheme cannot be made for a step so long.
template <class Measure>
double measured(Measure&& measure) {
    try {
        return measure();
    } catch (const InvalidScene&) {
        return unknown;
    }
}

void note(Found& found, const Trial& trial, const std::string& what, double value) {
    found.broken.push_back(what + " on " + trial.on.name + ": " + formatNumber(value, 4));
}

/// Steps to measure with, for the time of a subject: short ones, and for spaces that contain an oscillation,
/// which claim no order and are singular in short steps, those of 4 and of 10 radians.
std::vector<double> stepsOf(const Claims& claims, double usual) {
    return claims.order > 0 ? std::vector<double>{usual, 6} : std::vector<double>{1, 0.4};
}

bool claims(const Claims& c, const std::string& what) {
    return std::find(c.conserves.begin(), c.conserves.end(), what) != c.conserves.end();
}

}  // namespace

Trial trialOf(const Subject& on, const CatalogueScheme& scheme) {
    const ResolvedScheme& r = scheme.scheme;
    return {on,
            scheme.claims(),
            [&on, &r](double step) { return r.make(on.system, step, on.start); },
            scheme.degree <= 3,
            r.plain(),
            [&on, &r](double step) {
                const auto* const own = r.baseline ? r.baseline->parts.find<StepCheck>() : nullptr;
                const auto check = r.family ? r.family->check : own ? own->check : nullptr;
                extremal::Findings findings;
                const SchemeCase scene{on.system, on.start, r.discretization, step, r.isComposed(), false};
                if (check) check(scene, findings);
                return findings.errors.empty() && findings.warnings.empty();
            }};
}

std::optional<double> orderOf(const Trial& trial) {
    constexpr double lowest = 1e-11, highest = 1e-2;
    constexpr std::size_t points = 4;
    // Steps of many coordinates are dear, and a few of them tell orders apart.
    const double most = trial.on.start.x.size() > 12 ? 1200 : 4800;
    const int claimed = trial.claims.order;
    const double enough = claimed <= 1 ? 3e-3 : claimed == 2 ? 1e-5 : 1e-6;
    std::vector<double> h, e;
    const auto finest = [&](const std::vector<double>& v) {
        return std::vector(v.end() - static_cast<std::ptrdiff_t>(std::min(points, v.size())), v.end());
    };
    const auto next = [](double steps) {
        return steps < 4 ? 2 * steps : 4 * std::max(steps / 4 + 1, std::round(1.4 * steps / 4));
    };
    for (double steps = 1; steps < most; steps = next(steps)) {
        if (!trial.isSound(trial.on.time / steps)) continue;
        const double error = errorOf(trial, static_cast<long long>(steps));
        if (!(error < highest)) continue;
        if (error < lowest) break;
        h.push_back(-std::log(steps));
        e.push_back(std::log(error));
        const bool isClear =
            h.size() >= points && error < enough && std::abs(slope(finest(h), finest(e)) - claimed) < 0.15;
        if (isClear || error < 1e-10) break;
    }
    if (h.size() < 3) return {};
    double order = slope(finest(h), finest(e));
    // Where an error changes its sign it dips below its neighbours, and says nothing of the order.
    for (std::size_t k = h.size() - 1; order < claimed - half && k > 0 && h.size() > points; --k)
        if ((e[k] - e[k - 1]) / (h[k] - h[k - 1]) > claimed + 2) {
            h.erase(h.begin() + static_cast<std::ptrdiff_t>(k));
            e.erase(e.begin() + static_cast<std::ptrdiff_t>(k));
            order = slope(finest(h), finest(e));
        }
    // One or two steps are hardly small: they may show an order, but do not refute it.
    const bool isCoarse = -finest(h).front() < std::log(4);
    return isCoarse && order < claimed - half ? std::nullopt : std::optional(order);
}

double returnDefect(const Trial& trial, double each) {
    constexpr long long steps = 40;
    const Subject& on = trial.on;
    const double h = on.time / each;
    if (!trial.isSound(h)) return unknown;
    const auto there = after(*trial.make(h), on.start, steps);
    if (!there) return unknown;
    State back = *there;
    back.node = 0;
    const auto home = after(*trial.make(-h), back, steps);
    if (!home) return unknown;
    const double defect = distanceOn(on, *home, on.start);
    if (!(defect > 1e-10)) return defect;
    // Backwards what was damped grows, and rounding with it: by as much as a change of the end does.
    constexpr double change = 1e-7, ordinary = 1e4;
    State shaken = back;
    for (double& x : shaken.x) x += change * std::max(std::abs(x), 1e-3);
    const auto other = after(*trial.make(-h), shaken, steps);
    const double growth = other ? distanceOn(on, *other, *home) / distanceOn(on, shaken, back) : 0;
    return growth > ordinary ? defect / growth : defect;
}

double symplecticDefect(const Trial& trial, double each) {
    if (!trial.isSound(trial.on.time / each)) return unknown;
    if (trial.on.system.parts.find<Wave>()) return innerProductDefect(trial, each);
    if (const auto defect = ownFormDefect(trial, each)) return *defect;
    if (!trial.on.system.parts.find<Body>()) return canonicalDefect(trial, each);
    const Subject& on = trial.on;
    // Angles, momenta in the body, positions, linear momenta, each in the size of all three.
    Eigen::VectorXd own = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(on.start.x.size() - 4));
    for (std::size_t from = 4; from < on.start.x.size(); from += from == 4 ? 6 : 3) {
        double size = 0;
        for (std::size_t i = from; i < from + 3; ++i)
            for (const State& s : on.exact) size = std::max(size, std::abs(s.x[i]));
        own.segment<3>(from == 4 ? 3 : static_cast<Eigen::Index>(from - 4)).setConstant(size);
    }
    const auto integrator = trial.make(on.time / each);
    return bodySymplecticDefect(
        [&](State s) {
            integrator->begin(s);
            return after(*integrator, s, 1);
        },
        on.start, 1, own);
}

std::optional<double> conservedDefect(const Trial& trial, const std::string& what, double each) {
    const Subject& on = trial.on;
    constexpr int shortest = 3000;
    for (; each < shortest; each *= 4) {
        const double step = on.time / each;
        if (!trial.isSound(step)) continue;
        const auto integrator = trial.make(step);
        Watch watch(trial, what, step, *integrator);
        if (!watch.sees()) return {};
        State state = on.start;
        integrator->begin(state);
        double worst = watch.at(state, {}, *integrator, true);
        for (int k = 0; k < 100; ++k) {
            const StepReport report = advance(*integrator, state);
            if (report.outcome != Outcome::converged) return unknown;
            if (report.event != StepEvent::none) break;  // what is kept starts anew there
            worst = watch.at(state, report, *integrator, false);
        }
        if (distanceOn(on, state, on.start) < 100) return watch.hasSeen() ? worst : unknown;
    }
    return unknown;
}

void measure(Found& found, const Trial& trial) {
    ++found.subjects;
    // Without a claim the error depends on the periods in a step (oscillatory spaces).
    if (trial.claims.order > 0 && trial.isOrderVisible)
        if (const auto order = orderOf(trial)) {
            ++found.orders;
            found.nearestOrder = std::min(found.nearestOrder, std::abs(*order - trial.claims.order));
            if (*order < trial.claims.order - half) note(found, trial, "order", *order);
        }
    const auto add = [&](std::map<std::string, double>& to, const std::string& what, double each) {
        const double change = measured([&] { return conservedDefect(trial, what, each).value_or(unknown); });
        if (std::isfinite(change)) to[what] = std::max(to[what], change);
        return change;
    };
    for (const std::string& what : trial.claims.conserves) {
        double change = unknown;
        for (const double each : stepsOf(trial.claims, 24))
            if (std::isnan(change)) change = add(found.largestChange, what, each);
        if (change > conserved) note(found, trial, what, change);
    }
    // In long steps, because short ones of high order keep everything to round-off.
    for (const char* usual : {"momentum", "energy", "norm"}) {
        double change = claims(trial.claims, usual) ? 0 : unknown;
        for (const int each : {3, 6, 24})
            if (std::isnan(change)) change = add(found.largestInLongSteps, usual, each);
    }
    // Of what goes on from more than the state: laws.wave_three_level.
    if (!trial.claims.isOneStep) return;
    bool isAsked = trial.claims.isSymmetric;
    for (const double each : stepsOf(trial.claims, 20)) {
        const double back = measured([&] { return returnDefect(trial, each); });
        found.returns += std::isfinite(back) ? 1 : 0;
        if (back > found.largestReturn) found.largestReturn = back;
        if (isAsked && back > returned) note(found, trial, "does not return", back);
        // Longer steps than the first that can be taken amplify round-off by whatever the motion does to it.
        isAsked = isAsked && std::isnan(back);
    }
    double defect = unknown;
    for (const double each : stepsOf(trial.claims, 12))
        if (std::isnan(defect)) defect = measured([&] { return symplecticDefect(trial, each); });
    found.derivatives += std::isfinite(defect) ? 1 : 0;
    if (defect > found.largestSymplectic) found.largestSymplectic = defect;
    if (trial.claims.isSymplectic && defect > (trial.on.system.parts.find<Wave>() ? unitary : symplectic))
        note(found, trial, "not symplectic", defect);
}

void findGaps(Found& found, const CatalogueScheme& scheme) {
    const Claims& c = scheme.claims();
    // Higher orders leave double precision no window on most systems: laws.quadruple_order.
    if (c.order > 0 && c.order <= 6 && scheme.degree <= 3 && found.orders == 0)
        found.broken.push_back("the order was measured nowhere");
    if (c.isOneStep && c.isSymmetric && found.returns == 0)
        found.broken.push_back("symmetry was measured nowhere");
    if (c.isOneStep && c.isSymplectic && found.derivatives == 0)
        found.broken.push_back("symplecticity was measured nowhere");
}

void findModesty(Found& found, const CatalogueScheme& scheme, const Subject& on) {
    const Claims& c = scheme.claims();
    // Splittings for coordinates may gain an order on wave functions: on smooth potentials.
    const bool isBorrowed =
        on.system.parts.find<Wave>() && scheme.scheme.fits(systemNamed("harmonic-oscillator"));
    // Of weak kicks the terms of the order come after higher ones: the words with one kick, two and three are
    // measured by tableau.splitting_table.
    const bool isOfWeakKicks =
        scheme.scheme.plain() && scheme.scheme.discretization.space.type == "kepler-arcs";
    if (found.orders > 0 && found.nearestOrder > half && !isBorrowed && !isOfWeakKicks)
        found.broken.push_back("the order is better than claimed everywhere");
    if (!c.isOneStep) return;
    if (!c.isSymmetric && found.returns > 0 && found.largestReturn < returned)
        found.broken.push_back("returns everywhere, and does not claim it");
    if (!c.isSymplectic && found.derivatives > 0 && found.largestSymplectic < unitary)
        found.broken.push_back("is symplectic everywhere, and does not claim it");
    // The momentum of a variable that a one-form and its Hamiltonian do not have is kept by everything.
    const bool isCyclic = on.system.parts.find<OneForm>() != nullptr;
    for (const auto& [what, change] : found.largestInLongSteps)
        if (change < conserved && c.order > 0 && !(isCyclic && what == "momentum"))
            found.broken.push_back("conserves " + what + " everywhere, and does not claim it");
}

std::string Found::summary() const {
    std::string text = std::to_string(subjects) + " subjects, measured " + std::to_string(orders) +
                       " orders, " + std::to_string(returns) + " returns, " + std::to_string(derivatives) +
                       " derivatives: nearest order off by " + formatNumber(nearestOrder, 3) + ", return " +
                       formatNumber(largestReturn, 2) + ", symplectic " + formatNumber(largestSymplectic, 2);
    for (const auto& [what, change] : largestChange) text += ", " + what + " " + formatNumber(change, 2);
    return text;
}

ClaimSuite::ClaimSuite(SubjectKind kind, std::function<bool(const CatalogueScheme&)> isWanted)
    : subjects_(everySubject(kind)) {
    for (const Subject& on : subjects_)
        for (CatalogueScheme& c : everythingOn(on.system, on.start, on.time / 24))
            // Free times with many coordinates: seconds for a step that fails, and nothing that fewer
            // coordinates do not show.
            if (isWanted(c) && !(c.scheme.grid == TimeGrid::free && on.start.x.size() > 12))
                schemes_[c.name].emplace_back(&on, std::move(c));
}

std::vector<std::string> ClaimSuite::names() const {
    std::vector<std::string> all;
    for (const auto& [name, cases] : schemes_) all.push_back(name);
    return all;
}

const CatalogueScheme& ClaimSuite::scheme(const std::string& name) const {
    return schemes_.at(name).front().second;
}

Found ClaimSuite::examine(const std::string& name) const {
    Found found;
    for (const auto& [on, scheme] : schemes_.at(name)) measure(found, trialOf(*on, scheme));
    const CatalogueScheme& c = scheme(name);
    findGaps(found, c);
    const bool isNamed = c.group == Group::named || c.group == Group::baseline;
    if (isNamed && c.degree <= 3) findModesty(found, c, *schemes_.at(name).front().first);
    return found;
}

bool ClaimSuite::holds(const std::string& name) const {
    const Found found = examine(name);
    qInfo("%s", found.summary().c_str());
    for (const std::string& what : found.broken) qWarning("%s: %s", name.c_str(), what.c_str());
    return found.broken.empty();
}

}  // namespace extremal::laws
