// SPDX-License-Identifier: GPL-3.0-or-later
/// Laws of spins and vortices: orders against another route, which has the vectors alone and projects
/// nothing; lengths, sums, long runs, phases, derivatives, and refusals.
#include <QTest>

#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "engine/core/problem.hpp"
#include "engine/family/family.hpp"
#include "engine/model/spins/spins.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/test.hpp"

namespace extremal::spins_test {
namespace {

using namespace laws;
using Three = Eigen::Vector3d;
using List = std::vector<double>;

constexpr int sites = 8;

Three vectorAt(const List& s, int i) { return Eigen::Map<const Three>(s.data() + 3 * i); }

struct SpinCase {
    const char* name;
    const char* model;
    Value::Object keys;
    List spins;
    std::function<Three(const List& s, int i)> rate;
    double duration;
    int coarsest;

    System system() const {
        Value::Object all = keys;
        return systemNamed(model, all);
    }
    State start(const System& system) const {
        Value::Array list;
        for (std::size_t i = 0; i < spins.size(); i += 3)
            list.emplace_back(Value::Array{spins[i], spins[i + 1], spins[i + 2]});
        return {0, 0, system.start(Settings{"", {{"spins", list}}, {}}, 0)};
    }
    List reference() const {
        const auto rates = [this](const List& s, List& ds, double) {
            for (int i = 0; i < static_cast<int>(s.size() / 3); ++i)
                Eigen::Map<Three>(ds.data() + 3 * i) = rate(s, i);
        };
        boost::numeric::odeint::runge_kutta_fehlberg78<List> stepper;
        List s = spins;
        constexpr int steps = 2000;
        for (int k = 0; k < steps; ++k) stepper.do_step(rates, s, k * duration / steps, duration / steps);
        return s;
    }
};

List randomSpins(int count, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    List s;
    for (int i = 0; i < count; ++i) {
        const Three v = Three(normal(random), normal(random), normal(random)).normalized();
        s.insert(s.end(), v.data(), v.data() + 3);
    }
    return s;
}

Three neighbours(const List& s, int i) {
    return vectorAt(s, (i + 1) % sites) + vectorAt(s, (i + sites - 1) % sites);
}

SpinCase heisenberg() {
    return {"Heisenberg ring",
            "spins",
            {{"count", sites},
             {"bonds", "ring"},
             {"parameters", Value::Object{}},
             {"pair", "-(a1*b1 + a2*b2 + a3*b3)"},
             {"site", ""},
             {"weights", Value()}},
            randomSpins(sites, 3),
            [](const List& s, int i) -> Three { return -neighbours(s, i).cross(vectorAt(s, i)); },
            5,
            20};
}
SpinCase landauLifshitz() {
    return {"Landau-Lifshitz ring",
            "spins",
            {{"count", sites},
             {"bonds", "ring"},
             {"parameters", Value::Object{{"B", 0.3}, {"D", 0.2}}},
             {"pair", "-(a1*b1 + a2*b2 + a3*b3)"},
             {"site", "-B*s3 - D*s1^2"},
             {"weights", Value::Array{1, 2, 1, 0.5, 1, -1, 1, 1}}},
            randomSpins(sites, 5),
            [](const List& s, int i) -> Three {
                constexpr double weights[] = {1, 2, 1, 0.5, 1, -1, 1, 1};
                const Three field =
                    -neighbours(s, i) - 0.3 * Three::UnitZ() - 0.4 * vectorAt(s, i)(0) * Three::UnitX();
                return field.cross(vectorAt(s, i)) / weights[i];
            },
            5,
            20};
}
constexpr double strengths[] = {1, 1.5, -0.8, 0.7, -1.2};
SpinCase vortices() {
    return {"5 vortices",
            "vortices",
            {{"surface", "sphere"}, {"strengths", Value::Array{1, 1.5, -0.8, 0.7, -1.2}}},
            {0.6, 0, 0.8, 0, 0.8, 0.6, -0.6, 0.64, 0.48, -0.8, 0, -0.6, 0.48, -0.64, 0.6},
            [](const List& s, int i) -> Three {
                Three sum = Three::Zero();
                for (int j = 0; j < 5; ++j)
                    if (j != i)
                        sum += strengths[j] * vectorAt(s, j).cross(vectorAt(s, i)) /
                               (1 - vectorAt(s, i).dot(vectorAt(s, j)));
                return sum / (4 * std::numbers::pi);
            },
            5,
            20};
}

Discretization gaussPair(int degree) {
    return namedScheme("galerkin-gauss-" + std::to_string(degree)).value();
}

List spinsAt(const System& system, const State& state) {
    const SpinModel& model = *system.part<Spins>().model;
    List s(static_cast<std::size_t>(3 * model.count()));
    spins::spinsOf(model, state.x.data(), state.x.data() + 2 * model.count(), s.data());
    return s;
}
double lengthOff(const List& s) {
    double off = 0;
    for (int i = 0; i < static_cast<int>(s.size() / 3); ++i)
        off = std::max(off, std::abs(vectorAt(s, i).norm() - 1));
    return off;
}

std::string refusalOf(const char* model, const Value::Object& keys, const Value& start = {}) {
    try {
        const System system = systemNamed(model, keys);
        const State state{0, 0, system.start(Settings{"", {{"spins", start}}, {}}, 0)};
        findModel(model)->checkInitial(Settings{"", keys, {}}, system, state);
    } catch (const InvalidScene& e) {
        return e.problems()[0].pointer + " " + e.problems()[0].message;
    }
    return "accepted";
}

}  // namespace

class SpinsTest : public QObject {
    Q_OBJECT

private slots:
    void orders() {
        for (const SpinCase& each : {heisenberg(), landauLifshitz(), vortices()}) {
            const System system = each.system();
            const State start = each.start(system);
            QVERIFY(distance(spinsAt(system, start), each.spins, 0, each.spins.size()) < 1e-15);
            const List reference = each.reference();
            for (int s = 1; s <= 3; ++s) {
                double slope = 0, before = 0;
                std::string row;
                for (int n = each.coarsest; n <= 8 * each.coarsest; n *= 2) {
                    const auto end =
                        after(*makeIntegrator(system, gaussPair(s), {0, each.duration / n}), start, n);
                    QVERIFY(end);
                    const List now = spinsAt(system, *end);
                    const double error = distance(now, reference, 0, now.size());
                    row += QString::asprintf(" %.3e", error).toStdString();
                    if (error < 1e-12) break;
                    slope = std::log2(before / error);
                    before = error;
                    QVERIFY(lengthOff(now) < 1e-14);
                }
                qInfo("%s, s = %d:%s, slope %.2f", each.name, s, row.c_str(), slope);
                QVERIFY2(slope > 2 * s - 0.2 && slope < 2 * s + 0.3, each.name);
            }
        }
    }

    /// The spherical midpoint method: order 2, its step back, lengths and sums; its form is a claim
    /// (laws.claims_others).
    void sphericalMidpoint() {
        const auto make = [](const System& system, double h) {
            return findBaseline("spherical-midpoint")
                ->make(system, {h, {}, 0, Settings{"spherical-midpoint", {}, {}}});
        };
        for (const SpinCase& each : {heisenberg(), landauLifshitz(), vortices()}) {
            const System system = each.system();
            const State start = each.start(system);
            const List reference = each.reference();
            double slope = 0, before = 0;
            for (int n = 2 * each.coarsest; n <= 8 * each.coarsest; n *= 2) {
                const auto end = after(*make(system, each.duration / n), start, n);
                QVERIFY(end);
                const List now = spinsAt(system, *end);
                const double error = distance(now, reference, 0, now.size());
                slope = std::log2(before / error);
                before = error;
                QVERIFY(lengthOff(now) < 1e-14);
            }
            const auto there = after(*make(system, 0.1), start, 50),
                       back = after(*make(system, -0.1), *there, 50);
            QVERIFY(there && back);
            const double returned = distance(spinsAt(system, *back), each.spins, 0, each.spins.size());
            qInfo("%s: error %.2e, slope %.2f, back to %.1e", each.name, before, slope, returned);
            QVERIFY2(slope > 1.9 && slope < 2.1, each.name);
            QVERIFY(returned < 1e-12);
        }
        const System ring = heisenberg().system();
        const State start = heisenberg().start(ring);
        const auto end = after(*make(ring, 0.2), start, 20000);
        QVERIFY(end);
        double values[4];
        measureOf(ring, "momentum")->bind(start)(0, end->x.data(), values);
        qInfo("20000 steps: sum %.1e", values[3]);
        QVERIFY(values[3] < 1e-11);
        QVERIFY(!appliesTo(*findBaseline("spherical-midpoint"), systemNamed("pendulum")));
    }

    void kept() {
        const SpinCase each = landauLifshitz();
        const System ring = heisenberg().system();
        const Measure* const sums = measureOf(ring, "momentum");
        QCOMPARE(sums->columns.size(), std::size_t{4});
        // The field along 3 and the anisotropy along 1 leave nothing.
        QVERIFY(!measureOf(each.system(), "momentum"));
        const State start = heisenberg().start(ring);
        const auto end = after(*makeIntegrator(ring, gaussPair(2), {0, 0.2}), start, 20000);
        QVERIFY(end);
        double values[4];
        sums->bind(start)(0, end->x.data(), values);
        qInfo("20000 steps: lengths %.1e, sum %.1e", lengthOff(spinsAt(ring, *end)), values[3]);
        QVERIFY(lengthOff(spinsAt(ring, *end)) < 1e-12);
        QVERIFY(values[3] < 1e-12);
    }

    void energyWithoutDrift() {
        const SpinCase each = landauLifshitz();
        const System system = each.system();
        for (const int s : {1, 2}) {
            const auto integrator = makeIntegrator(system, gaussPair(s), {0, 0.1});
            State state = each.start(system);
            integrator->begin(state);
            const double energy = system.energy(0, state.x.data());
            double quarters[4] = {};
            constexpr int steps = 40000;
            for (int k = 0; k < steps; ++k) {
                QVERIFY(advance(*integrator, state).outcome == Outcome::converged);
                double& worst = quarters[4 * k / steps];
                worst = std::max(worst, std::abs(system.energy(0, state.x.data()) - energy));
            }
            qInfo("s = %d: energy %.2e %.2e %.2e %.2e", s, quarters[0], quarters[1], quarters[2],
                  quarters[3]);
            QVERIFY(quarters[3] < 2 * quarters[0]);
        }
    }

    void phases() {
        const SpinCase each = landauLifshitz();
        const System system = each.system();
        const State start = each.start(system);
        State turned = start;
        constexpr double weights[] = {1, 2, 1, 0.5, 1, -1, 1, 1};
        for (std::size_t i = 0; i < sites; ++i) {
            const double angle = 0.7 * static_cast<double>(i) + 0.3, w = 4 * weights[i];
            for (const std::size_t k : {2 * i, 2 * i + 1}) {
                double &re = turned.x[k], &im = turned.x[2 * sites + k];
                const double a = re, b = im / w;
                re = std::cos(angle) * a - std::sin(angle) * b;
                im = w * (std::sin(angle) * a + std::cos(angle) * b);
            }
        }
        QVERIFY(distance(turned.x, start.x, 0, start.x.size()) > 0.1);
        const auto one = after(*makeIntegrator(system, gaussPair(2), {0, 0.1}), start, 100),
                   other = after(*makeIntegrator(system, gaussPair(2), {0, 0.1}), turned, 100);
        QVERIFY(one && other);
        const List s = spinsAt(system, *one);
        const double apart = distance(s, spinsAt(system, *other), 0, s.size());
        qInfo("other phases: %.1e", apart);
        QVERIFY(apart < 1e-11);
    }

    void derivatives() {
        for (const SpinCase& each : {landauLifshitz(), vortices()}) {
            const System system = each.system();
            const PhaseMechanics& H = system.part<PhaseMechanics>();
            const auto n = static_cast<std::size_t>(2 * H.dimension);
            List x = each.start(system).x, gradient(n), up(n), down(n), hessian(n * n);
            const std::size_t d = n / 2;
            H.gradient(H.model.get(), 0, x.data(), x.data() + d, gradient.data());
            H.hessian(H.model.get(), 0, x.data(), x.data() + d, hessian.data());
            constexpr double h = 1e-5;
            for (std::size_t k = 0; k < n; ++k) {
                const double at = x[k];
                x[k] = at + h;
                const double above = H.energy(H.model.get(), 0, x.data(), x.data() + d);
                H.gradient(H.model.get(), 0, x.data(), x.data() + d, up.data());
                x[k] = at - h;
                const double below = H.energy(H.model.get(), 0, x.data(), x.data() + d);
                H.gradient(H.model.get(), 0, x.data(), x.data() + d, down.data());
                x[k] = at;
                QVERIFY(std::abs((above - below) / (2 * h) - gradient[k]) < 1e-8);
                for (std::size_t l = 0; l < n; ++l)
                    QVERIFY(std::abs((up[l] - down[l]) / (2 * h) - hessian[k * n + l]) < 1e-7);
            }
        }
    }

    void refusals() {
        Value::Object keys = heisenberg().keys;
        const auto with = [&keys](const char* key, const Value& value) {
            Value::Object other = keys;
            for (auto& [name, old] : other)
                if (name == key) old = value;
            return other;
        };
        QVERIFY(refusalOf("spins", with("pair", "a1*c")).starts_with("/pair"));
        QVERIFY(refusalOf("spins", with("pair", "")).starts_with(" has no energy"));
        QVERIFY(
            refusalOf("spins", with("bonds", Value::Array{Value::Array{1, 9}})).starts_with("/bonds/0/1"));
        QVERIFY(refusalOf("spins", with("weights", Value::Array{1, 0})).starts_with("/weights/1"));
        QVERIFY(refusalOf("spins", with("weights", Value::Array{1, 2})).starts_with("/weights has 2"));
        QVERIFY(refusalOf("spins", keys, Value::Array(sites, Value::Array{0, 0, 2}))
                    .starts_with("/spins/0 has the length 2"));
        QCOMPARE(refusalOf("spins", keys), std::string("accepted"));
        QVERIFY(refusalOf("vortices", {{"surface", "sphere"}, {"strengths", Value::Array{1, 1}}},
                          Value::Array(2, Value::Array{0, 0, 1}))
                    .find("at one place") != std::string::npos);
        // q and p apart: lengths do not stay.
        const System system = heisenberg().system();
        Discretization lobatto = gaussPair(2);
        lobatto.quadrature = completeQuadrature(lobatto.space, {"lobatto", {}, {}});
        QVERIFY(!mismatch(lobatto, system).empty());
        const auto apart = after(*makeIntegrator(system, lobatto, {0, 0.2}), heisenberg().start(system), 100);
        QVERIFY(apart);
        qInfo("Lobatto(3), 100 steps: lengths %.1e", lengthOff(spinsAt(system, *apart)));
        QVERIFY(lengthOff(spinsAt(system, *apart)) > 1e-7);
        QVERIFY(mismatch(gaussPair(2), system).empty());
    }
};

EXTREMAL_TEST(SpinsTest)
}  // namespace extremal::spins_test

#include "spins_test.moc"
