// SPDX-License-Identifier: GPL-3.0-or-later
/// Free motion of fields in Fourier modes between kicks: steps are stationary for the action as it is
/// written, orders in u and u_t, over lines and rectangles and of two components; refusals with their place.
#include <QTest>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/family/scheme.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/tableau/splitting_table.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/slope.hpp"
#include "tests/tools/test.hpp"

namespace extremal::free_field_test {
namespace {

struct Field {
    const char* name;
    const char* model;
    const char* initial;
};
const Field fields[] = {
    {"sine-Gordon",
     R"J({"type":"field","potential":"sine-gordon","domain":[-5,5],"boundary":"periodic","cells":24})J",
     R"J({"u":"2*cos(pi*x/5)+0.3*sin(2*pi*x/5)","u_t":"0.5*sin(pi*x/5)"})J"},
    {"phi-4, odd",
     R"J({"type":"field","potential":"phi4","domain":[-4,4],"boundary":"periodic","cells":21,"wave_speed":0.8})J",
     R"J({"u":"0.7*cos(pi*x/4)+0.2","u_t":"0.2*sin(pi*x/4)"})J"},
    {"two components",
     R"J({"type":"field-2d","potential":{"name":"klein-gordon-complex","lambda":0.5},"components":["u","v"],"domain":[-3,3],"domain_y":[-2,2],"cells":10,"cells_y":8})J",
     R"J({"u":"0.8*cos(pi*x/3)*cos(pi*y/2)+0.1","v":"0.5*sin(pi*x/3)","u_t":"0.3*sin(pi*y/2)","v_t":"0.2"})J"}};

struct Case {
    System system;
    State start;
};
/// As the scheme has it: a line becomes trigonometric polynomials.
Case caseOf(const Field& f, const std::string& space) {
    const ReadScene read =
        readScene(std::string(R"J({"extremal":1,"model":)J") + f.model + R"J(,"initial":)J" + f.initial +
                  R"J(,"time":{"end":2},"schemes":[{"step":0.1,"space":)J" + space + "}]}");
    if (!read.resolved) qFatal("%s: %s", f.name, read.errors.front().message.c_str());
    const ResolvedScheme& s = read.resolved->schemes.front();
    if (s.ownSystem) return {*s.ownSystem, s.ownInitial};
    const System system = makeSystem(read.scene);
    return {system, initialState(read.scene, system)};
}
std::string knots(const std::string& id) { return "{\"type\":\"free-motion\",\"knots\":\"" + id + "\"}"; }
Discretization discretization(const std::string& id) {
    return {{"free-motion", {{"knots", id}}, {}}, {"auto", {}, {}}, {}};
}
Discretization withMass(Discretization d, double mass) {
    d.space.keys.emplace_back("mass", mass);
    return d;
}

/// The free motion of all nodes over a time, without Fourier transforms.
class Slow {
public:
    Slow(std::vector<int> sizes, std::vector<double> lengths, double stiffness, double w)
        : sizes_(std::move(sizes)), lengths_(std::move(lengths)), stiffness_(stiffness), w_(w) {}
    std::size_t nodes() const {
        std::size_t all = 1;
        for (const int n : sizes_) all *= static_cast<std::size_t>(n);
        return all;
    }
    /// Every node takes a share of every other, a sum over wave numbers of cosines of their distance.
    void move(std::vector<double>& u, std::vector<double>& v, double time) const {
        const std::size_t n = nodes();
        std::vector<double> newU(n), newV(n);
        const int nx = sizes_[0], ny = sizes_.size() > 1 ? sizes_[1] : 1;
        for (int i = 0; i < nx * ny; ++i)
            for (int j = 0; j < nx * ny; ++j) {
                double c = 0, s = 0, back = 0;
                for (int k = -(nx - 1) / 2; k <= nx / 2; ++k)
                    for (int l = -(ny - 1) / 2; l <= ny / 2; ++l) {
                        const double a = 2 * std::numbers::pi * k / lengths_[0],
                                     b = ny > 1 ? 2 * std::numbers::pi * l / lengths_[1] : 0,
                                     frequency = std::sqrt(stiffness_ * (a * a + b * b) + w_),
                                     phase = 2 * std::numbers::pi *
                                             (static_cast<double>(k * (i % nx - j % nx)) / nx +
                                              static_cast<double>(l * (i / nx - j / nx)) / ny),
                                     weight = std::cos(phase) / (nx * ny);
                        c += weight * std::cos(frequency * time);
                        s += weight * (frequency > 0 ? std::sin(frequency * time) / frequency : time);
                        back -= weight * frequency * std::sin(frequency * time);
                    }
                newU[static_cast<std::size_t>(i)] +=
                    c * u[static_cast<std::size_t>(j)] + s * v[static_cast<std::size_t>(j)];
                newV[static_cast<std::size_t>(i)] +=
                    back * u[static_cast<std::size_t>(j)] + c * v[static_cast<std::size_t>(j)];
            }
        u = newU;
        v = newV;
    }

private:
    std::vector<int> sizes_;
    std::vector<double> lengths_;
    double stiffness_, w_;
};

}  // namespace

class FreeFieldTest : public QObject {
    Q_OBJECT

private slots:
    /// Of odd numbers of nodes every mode is a part of the space: free motions by sums of cosines over all
    /// nodes, kicks at the nodes by the derivative of the potential.
    void stepsAreThoseOfTheAction_data() {
        QTest::addColumn<double>("mass");
        // The mean of W'' = 3 u^2 - 1 over |u| <= 1 is 0.
        QTest::newRow("mean of the curvature") << -1.0;
        QTest::newRow("mass of 1.3") << 1.3;
    }
    void stepsAreThoseOfTheAction() {
        QFETCH(double, mass);
        const double w = std::max(mass, 0.0);
        const Case of = caseOf(fields[1], knots("srkn-6b"));
        const int n = 21;
        const Slow slow({n}, {8}, 0.64, w);
        State state = of.start;
        const double h = 0.3;
        const Discretization plain = discretization("srkn-6b");
        const auto integrator = makeIntegrator(of.system, mass < 0 ? plain : withMass(plain, mass), {0, h});
        std::vector<double> u(of.start.x.begin(), of.start.x.begin() + n),
            v(of.start.x.begin() + n, of.start.x.end());
        for (int step = 0; step < 3; ++step) {
            QCOMPARE(advance(*integrator, state).outcome, Outcome::converged);
            for (const SplittingStage& s : srkn6b().stages) {
                if (!s.isKick) {
                    slow.move(u, v, s.fraction * h);
                    continue;
                }
                for (std::size_t i = 0; i < n; ++i)
                    v[i] -= s.fraction * h * (u[i] * u[i] * u[i] - u[i] - w * u[i]);
            }
        }
        double most = 0;
        for (std::size_t i = 0; i < n; ++i)
            most = std::max({most, std::abs(u[i] - state.x[i]), std::abs(v[i] - state.x[n + i])});
        qInfo("%.1e", most);
        QVERIFY(most < 1e-13);
    }
    void ordersInValueAndRate_data() {
        QTest::addColumn<int>("field");
        QTest::addColumn<QString>("id");
        QTest::addColumn<int>("order");
        QTest::addColumn<double>("mass");  // negative: the mean of W''
        for (const double mass : {0.0, 2.0})
            for (const auto& [id, order] : {std::pair{"srkn-6b", 4}, {"srkn-11b", 6}})
                QTest::addRow("%s, %s, mass %g", fields[0].name, id, mass)
                    << 0 << QString(id) << order << mass;
        for (int f = 0; f < static_cast<int>(std::size(fields)); ++f)
            for (const auto& [id, order] : {std::pair{"strang", 2},
                                            {"suzuki-4", 4},
                                            {"blanes-moan-s6", 4},
                                            {"srkn-6b", 4},
                                            {"blanes-moan-s10", 6},
                                            {"srkn-11b", 6},
                                            {"srkn-14a", 6},
                                            {"srkn-19a", 8},
                                            {"srkn-19b", 8}})
                QTest::addRow("%s, %s", fields[f].name, id) << f << QString(id) << order << -1.0;
    }
    /// Against Gauss of degree 8 on the same modes.
    void ordersInValueAndRate() {
        QFETCH(int, field);
        QFETCH(QString, id);
        QFETCH(int, order);
        QFETCH(double, mass);
        const Case of = caseOf(fields[field], knots(id.toStdString()));
        const Discretization plain = discretization(id.toStdString()),
                             scheme = mass < 0 ? plain : withMass(plain, mass);
        QCOMPARE(describe(scheme, of.system).claims.order, order);
        const auto endOf = [&](const Discretization& d, int n) {
            const auto integrator = makeIntegrator(of.system, d, {0, 2.0 / n});
            return laws::after(*integrator, of.start, n).value().x;
        };
        const auto exact = endOf(*namedScheme("field-gauss-8"), 60);
        const std::size_t half = exact.size() / 2;
        std::vector<double> steps, values, rates;
        for (int n = 3; n < 3000; n = static_cast<int>(std::ceil(1.3 * n))) {
            const auto x = endOf(scheme, n);
            const double u = laws::distance(x, exact, 0, half), v = laws::distance(x, exact, half, 2 * half);
            if (u < 3e-12 || v < 3e-12) break;
            if (u > 1e-2) continue;
            steps.push_back(-std::log(n));
            values.push_back(std::log(u));
            rates.push_back(std::log(v));
        }
        const auto last = static_cast<std::ptrdiff_t>(std::min<std::size_t>(5, steps.size()));
        QVERIFY(last >= 3);
        for (auto* each : {&steps, &values, &rates}) each->erase(each->begin(), each->end() - last);
        qInfo("u %.2f, u_t %.2f", slope(steps, values), slope(steps, rates));
        for (const double found : {slope(steps, values), slope(steps, rates)})
            // srkn-14a and those of order 8 come to their order where errors are round-off.
            QVERIFY(found > order - 0.3 && (found < order + 0.4 || order == 8 || id == "srkn-14a"));
    }
    void whatHasNoFreeWavesIsRefused() {
        const auto refused = [&](const std::string& model, const std::string& space, const char* place,
                                 const char* because) {
            const ReadScene read = readScene(
                R"J({"extremal":1,"model":)J" + model +
                R"J(,"initial":{"u":"exp(-x^2)"},"time":{"end":1},"schemes":[{"step":0.1,"space":)J" + space +
                "}]}");
            QVERIFY(!read.errors.empty());
            const Problem& first = read.errors.front();
            qInfo("%s: %s (%s)", first.pointer.c_str(), first.message.c_str(), first.hint.c_str());
            QVERIFY2(first.pointer.find(place) != std::string::npos, first.pointer.c_str());
            QVERIFY2(first.message.find(because) != std::string::npos, first.message.c_str());
        };
        refused(R"J({"type":"field","potential":"phi4","domain":[-5,5],"boundary":"dirichlet","cells":20})J",
                knots("strang"), "/schemes/0", "periodic");
        refused(
            R"J({"type":"field","potential":"none","domain":[-5,5],"boundary":"periodic","cells":20,"a":"1+0.2*cos(2*pi*s)"})J",
            knots("strang"), "/schemes/0", "one wave speed");
        refused(
            R"J({"type":"field-2d","potential":"phi4","domain":[-5,5],"domain_y":[-5,5],"cells":12,"cells_y":12})J",
            R"J({"type":"free-motion","knots":"strang","modes":8})J", "/space/modes", "modes are for fields");
        refused(R"J({"type":"field","potential":"phi4","domain":[-5,5],"boundary":"periodic","cells":20})J",
                R"J({"type":"free-motion","mass":-1})J", "/space/mass", "non-negative");
        const System bar = laws::systemNamed("elastic-bar");
        QVERIFY(mismatch(withMass(discretization("strang"), 1), laws::systemNamed("pendulum"))
                    .find("a mass term is for fields") != std::string::npos);
        QVERIFY(mismatch(discretization("strang"), bar).find("free waves") != std::string::npos);
        QVERIFY_THROWS_EXCEPTION(InvalidScene, (void)makeIntegrator(bar, discretization("strang"), {0, 0.1}));
    }
    /// With modes of its own a scheme has them as nodes, and is spectral: a breather.
    void modesOfItsOwn() {
        const Field breather{
            "breather",
            R"J({"type":"field","potential":"sine-gordon","domain":[-40,40],"boundary":"periodic","cells":40})J",
            R"J({"profile":"breather","omega":0.8})J"};
        double before = 0;
        for (const int modes : {64, 96, 128}) {
            const Case of = caseOf(breather, R"J({"type":"free-motion","knots":"srkn-14a","modes":)J" +
                                                 std::to_string(modes) + "}");
            QCOMPARE(of.start.x.size(), 2 * static_cast<std::size_t>(modes));
            const auto integrator = makeIntegrator(of.system, discretization("srkn-14a"), {0, 0.2});
            const State end = laws::after(*integrator, of.start, 50).value();
            std::vector<double> exact(end.x.size());
            of.system.exactFrom({"", {{"profile", "breather"}, {"omega", 0.8}}, {}}, of.start)(end.t, exact);
            double error = 0;
            for (std::size_t i = 0; i < static_cast<std::size_t>(modes); ++i)
                error = std::max(error, std::abs(end.x[i] - exact[i]));
            qInfo("%d modes: %.1e", modes, error);
            if (before > 0) QVERIFY(error < 0.05 * before);
            before = error;
        }
        QVERIFY(before < 1e-5);
    }
};

EXTREMAL_TEST(FreeFieldTest)

}  // namespace extremal::free_field_test

#include "free_field_test.moc"
