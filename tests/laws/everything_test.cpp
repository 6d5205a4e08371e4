/// Every scheme on every system: the order, symmetry, symplecticity and momenta that it claims, measured on
/// each system of the presets that it fits. What a scheme does not claim it must miss on at least one of
/// them.
#include <QTest>

#include <algorithm>
#include <limits>
#include <map>

#include "engine/integrator/composition.hpp"
#include "tests/laws/subjects.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::everything_test {
namespace {

std::vector<Case> schemesOn(const System& system) {
    std::vector<Case> cases = everyScheme(3, system);
    const std::size_t simple = cases.size();
    for (std::size_t i = 0; i < simple; ++i) {
        const Case c = cases[i];
        if (!c.claims.isSymmetric || c.claims.order != 2) continue;
        const Settings composition{c.isPair ? "yoshida" : "suzuki", {{"order", 4.0}}, {}};
        Case made = c;
        made.name = composition.type + " of " + c.name;
        made.claims = composedClaims(composition, c.claims);
        made.make = [make = c.make, parts = compositionParts(composition, 2)](
                        const System& s, const Clock& clock) { return composed(parts, *make(s, clock)); };
        cases.push_back(std::move(made));
    }
    return cases;
}

/// Slope of the error over the finest steps whose errors say something; none where the scheme is exact on the
/// system.
std::optional<double> orderOn(const Subject& on, const Case& scheme) {
    constexpr double lowest = 1e-11, highest = 1e-2;
    std::vector<double> h, e;
    for (double quarter = 1; quarter < 1200; quarter = std::max(quarter + 1, std::round(1.4 * quarter))) {
        const auto each = static_cast<long long>(quarter);
        const double step = on.time / static_cast<double>(4 * each);
        const auto integrator = scheme.make(on.system, {on.start.t, step});
        State state = on.start;
        double error = 0;
        bool isSolved = true;
        for (const State& exact : on.exact) {
            const auto next = after(*integrator, state, each);
            isSolved = isSolved && next;
            if (!isSolved) break;
            state = *next;
            error = std::max(error, distanceOn(on, state, exact));
        }
        if (!isSolved || error > highest) continue;
        if (error < lowest) break;
        h.push_back(std::log(step));
        e.push_back(std::log(error));
    }
    constexpr std::size_t points = 4;
    if (h.size() < 3) return {};
    if (h.size() > points) {
        h.erase(h.begin(), h.end() - points);
        e.erase(e.begin(), e.end() - points);
    }
    return slope(h, e);
}

/// Distance from the start after some steps there and as many back; `each`: steps for the time of the system.
double returnDefect(const Subject& on, const Case& scheme, int each) {
    constexpr long long steps = 40;
    const double h = on.time / each;
    const auto there = after(*scheme.make(on.system, {on.start.t, h}), on.start, steps);
    if (!there) return std::numeric_limits<double>::quiet_NaN();
    State back = *there;
    back.node = 0;
    const auto home = after(*scheme.make(on.system, {there->t, -h}), back, steps);
    return home ? distanceOn(on, *home, on.start) : std::numeric_limits<double>::quiet_NaN();
}

/// Size of M^T J M - J over the largest entry of M, for the derivative M of one step by central differences
/// of order 6. Every coordinate is measured in its own size, every entry (i, j) in the root of the actions of
/// i and j.
double symplecticDefect(const Subject& on, const Case& scheme) {
    constexpr std::array<double, 3> weight = {45. / 60, -9. / 60, 1. / 60};
    const double h = on.time / 12, delta = 5e-4;
    const std::size_t n = on.start.x.size(), d = on.half();
    const auto action = [&](std::size_t i) { return on.own[i % d] * on.own[i % d + d]; };
    std::vector<double> M(n * n);
    const auto integrator = scheme.make(on.system, {on.start.t, h});
    for (std::size_t j = 0; j < n; ++j)
        for (int k = 1; k <= 3; ++k)
            for (const int sign : {1, -1}) {
                State s = on.start;
                s.x[j] += sign * k * delta * on.own[j];
                integrator->begin(s);
                const auto end = after(*integrator, s, 1);
                if (!end) return std::numeric_limits<double>::quiet_NaN();
                for (std::size_t i = 0; i < n; ++i)
                    M[i * n + j] +=
                        sign * weight[static_cast<std::size_t>(k - 1)] * end->x[i] / (delta * on.own[i]);
            }
    double largest = 0, defect = 0;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
            largest = std::max(largest, std::abs(M[i * n + j]));
            double w = j == i + d ? -action(i) : i == j + d ? action(j) : 0;
            for (std::size_t k = 0; k < d; ++k)
                w += action(k) * (M[k * n + i] * M[(k + d) * n + j] - M[(k + d) * n + i] * M[k * n + j]);
            defect = std::max(defect, std::abs(w) / std::sqrt(action(i) * action(j)));
        }
    return defect / largest;
}

double momentumDefect(const Subject& on, const Case& scheme) {
    double worst = 0;
    const auto integrator = scheme.make(on.system, {on.start.t, on.time / 24});
    State state = on.start;
    const std::size_t p = isBody(on.system) ? 0 : on.half();
    for (int k = 0; k < 100; ++k) {
        if (advance(*integrator, state).outcome != Outcome::converged)
            return std::numeric_limits<double>::quiet_NaN();
        for (const MomentumMap& map : on.system.momenta) {
            const double before = map.value(on.start.x.data(), on.start.x.data() + p),
                         now = map.value(state.x.data(), state.x.data() + p);
            worst = std::max(worst, std::abs(now - before) /
                                        (isBody(on.system) ? 1 : std::max(1.0, on.scaleQ) * on.scaleP));
        }
    }
    return worst;
}

/// What a scheme was found to do, over the systems it fits.
struct Findings {
    std::string name;
    Claims claims;
    double nearestOrder =
        std::numeric_limits<double>::infinity();  ///< distance from the claim on the system that fits best
    double largestReturn = 0, largestSymplectic = 0, largestMomentum = 0;
    int systems = 0, orders = 0, returns = 0, momenta = 0,
        derivatives = 0;  ///< measured; a step too long for a solver is not
    std::vector<std::string> broken;
};

void note(Findings& f, const Subject& on, const std::string& what, double value) {
    f.broken.push_back(what + " on " + on.name + ": " + std::to_string(value));
}

bool claimsMomentum(const Claims& c) {
    return std::find(c.conserves.begin(), c.conserves.end(), "momentum") != c.conserves.end();
}

constexpr double half =
    0.5;  ///< orders are whole numbers: a slope that rounds to another one is another order

void look(Findings& f, const Subject& on, const Case& scheme) {
    ++f.systems;
    if (const auto order = orderOn(on, scheme)) {
        ++f.orders;
        f.nearestOrder = std::min(f.nearestOrder, std::abs(*order - f.claims.order));
        if (*order < f.claims.order - half) note(f, on, "order", *order);
    }
    for (const int each : {20, 6}) {
        const double back = returnDefect(on, scheme, each);
        f.returns += std::isfinite(back) ? 1 : 0;
        if (back > f.largestReturn) f.largestReturn = back;
        // Long steps amplify round-off by whatever the motion does to it.
        if (f.claims.isSymmetric && each == 20 && back > 1e-9) note(f, on, "does not return", back);
    }
    const double momentum = momentumDefect(on, scheme);
    f.momenta += std::isfinite(momentum) ? 1 : 0;
    if (momentum > f.largestMomentum) f.largestMomentum = momentum;
    if (claimsMomentum(f.claims) && momentum > 1e-11) note(f, on, "momentum", momentum);
    if (isBody(on.system)) return;  // not in coordinates: laws.body_claims
    const double defect = symplecticDefect(on, scheme);
    f.derivatives += std::isfinite(defect) ? 1 : 0;
    if (defect > f.largestSymplectic) f.largestSymplectic = defect;
    if (f.claims.isSymplectic && defect > 1e-7) note(f, on, "not symplectic", defect);
}

/// Claims that are not made must be missed somewhere, or they could be made.
void lookAtModesty(Findings& f, bool isOnBodies) {
    if (f.orders > 0 && f.nearestOrder > half)
        f.broken.push_back("the order is better than claimed everywhere");
    if (!f.claims.isSymmetric && f.largestReturn < 1e-9)
        f.broken.push_back("returns everywhere, and does not claim it");
    if ((f.claims.order > 0 && f.orders == 0) || f.returns == 0 || f.momenta == 0 ||
        (!isOnBodies && f.derivatives == 0))
        f.broken.push_back("a claim was measured nowhere");
    if (isOnBodies) return;
    if (!f.claims.isSymplectic && f.largestSymplectic < 1e-6)
        f.broken.push_back("is symplectic everywhere, and does not claim it");
}

}  // namespace

class EverythingTest : public QObject {
    Q_OBJECT
    std::vector<Subject> systems_;
    std::map<std::string, std::vector<std::pair<std::size_t, Case>>>
        schemes_;  ///< by name: system and scheme

private slots:
    void initTestCase() {
        systems_ = everySystem();
        for (std::size_t i = 0; i < systems_.size(); ++i)
            for (const Case& c : schemesOn(systems_[i].system)) schemes_[c.name].emplace_back(i, c);
        qInfo("%zu systems, %zu schemes", systems_.size(), schemes_.size());
        QVERIFY(systems_.size() >= 14 && schemes_.size() >= 30);
    }
    void everyClaimHoldsOnEverySystem_data() {
        QTest::addColumn<QString>("name");
        // initTestCase runs before; rows are known by then.
        for (const auto& [name, cases] : schemes_)
            QTest::addRow("%s", name.c_str()) << QString::fromStdString(name);
    }
    void everyClaimHoldsOnEverySystem() {
        QFETCH(QString, name);
        const auto& cases = schemes_.at(name.toStdString());
        Findings f;
        f.claims = cases.front().second.claims;
        bool isOnBodies = true;
        for (const auto& [i, scheme] : cases) {
            isOnBodies = isOnBodies && isBody(systems_[i].system);
            look(f, systems_[i], scheme);
        }
        lookAtModesty(f, isOnBodies);
        qInfo(
            "%d systems, measured %d orders, %d returns, %d derivatives, %d momenta: nearest order off by "
            "%.3f, return %.1e, symplectic %.1e, momentum %.1e",
            f.systems, f.orders, f.returns, f.derivatives, f.momenta, f.nearestOrder, f.largestReturn,
            f.largestSymplectic, f.largestMomentum);
        for (const std::string& what : f.broken) qWarning("%s", what.c_str());
        QVERIFY(f.broken.empty());
    }
    void brokenSchemesAreFound_data() {
        QTest::addColumn<QString>("what");
        for (const char* what : {"order", "does not return", "not symplectic", "momentum"})
            QTest::newRow(what) << QString(what);
    }
    /// A midpoint rule that claims too much, or that loses a part in ten thousand of its momentum at every
    /// step.
    void brokenSchemesAreFound() {
        QFETCH(QString, what);
        class Leaking final : public Integrator {
        public:
            explicit Leaking(std::unique_ptr<Integrator> inner) : inner_(std::move(inner)) {}
            double stepSize() const override { return inner_->stepSize(); }
            void setStep(double h) override { inner_->setStep(h); }
            std::unique_ptr<Integrator> clone() const override {
                return std::make_unique<Leaking>(inner_->clone());
            }
            StepReport advance(State& state, double until) override {
                const StepReport r = inner_->advance(state, until);
                for (std::size_t i = state.x.size() / 2; i < state.x.size(); ++i) state.x[i] *= 1 - 1e-4;
                return r;
            }
            void denseOutput(double tau, std::span<double> x) const override { inner_->denseOutput(tau, x); }

        private:
            std::unique_ptr<Integrator> inner_;
        };
        bool isFound = false;
        for (const Subject& s : systems_) {
            if (isBody(s.system)) continue;
            Findings f;
            const auto cases = everyScheme(1, s.system);
            Case broken =
                *std::find_if(cases.begin(), cases.end(), [](const Case& c) { return c.name == "midpoint"; });
            f.claims = broken.claims;
            if (what == "order")
                f.claims.order = 4;
            else
                broken.make = [make = broken.make](const System& system, const Clock& clock) {
                    return std::make_unique<Leaking>(make(system, clock));
                };
            look(f, s, broken);
            isFound = isFound || std::any_of(f.broken.begin(), f.broken.end(), [&](const std::string& b) {
                          return b.starts_with(what.toStdString());
                      });
        }
        QVERIFY(isFound);
    }
};

EXTREMAL_TEST(EverythingTest)
}  // namespace extremal::laws::everything_test

#include "everything_test.moc"
