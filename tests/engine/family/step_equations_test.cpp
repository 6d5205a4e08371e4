// SPDX-License-Identifier: GPL-3.0-or-later
/// The equations of a step of bodies, fields and wave functions: their matrices against differences of
/// actions that are written down here, their discrete Lagrangians against actions that are known.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/core/problem.hpp"
#include "engine/family/field/discretization.hpp"
#include "engine/family/field/slab_actions.hpp"
#include "engine/family/step_equations.hpp"
#include "engine/figure/figure.hpp"
#include "engine/group/so3.hpp"
#include "engine/model/static_problem.hpp"
#include "engine/run/exact_actions.hpp"
#include "engine/run/kkt_pattern.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/engine/family/field/fields.hpp"
#include "tests/tools/test.hpp"

namespace extremal::step_equations_test {
namespace {

using fields::FieldCase;
using fields::makeField;
using fields::rule;
using fields::tents;

System bodyOf(const char* model, Value::Object keys = {}) {
    const ModelEntry& entry = *findModel(model);
    Settings settings{model, {}, {}};
    for (const FieldInfo& field : entry.item.parameters) {
        const auto own = std::find_if(keys.begin(), keys.end(),
                                      [&](const Value::Member& m) { return m.first == field.key; });
        settings.keys.emplace_back(field.key, own != keys.end()        ? own->second
                                              : field.example.isNull() ? field.fallback
                                                                       : field.example);
    }
    return entry.make(settings);
}

/// The state of a body whose axes are those of space: attitude, momenta in body and in space.
State turning(double a, double b, double c) { return {0, 0, {1, 0, 0, 0, a, b, c, a, b, c}}; }

/// d^2 S / dz_i dz_j by differences of values.
Eigen::MatrixXd hessianOf(const std::function<double(const Eigen::VectorXd&)>& S, const Eigen::VectorXd& z,
                          double e = 1e-3) {
    const auto n = z.size();
    Eigen::MatrixXd H(n, n);
    const auto at = [&](Eigen::Index i, double di, Eigen::Index j, double dj) {
        Eigen::VectorXd x = z;
        x(i) += di;
        x(j) += dj;
        return S(x);
    };
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j)
            H(i, j) = (at(i, e, j, e) - at(i, e, j, -e) - at(i, -e, j, e) + at(i, -e, j, -e)) / (4 * e * e);
    return H;
}

/// The body rate of the curve exp(xi(t)), from the series of dexp: sum (-1)^k ad^k / (k + 1)! .
Eigen::Vector3d rateOf(const Eigen::Vector3d& xi, const Eigen::Vector3d& v) {
    Eigen::Vector3d term = v, sum = v;
    for (int k = 1; k < 30; ++k) {
        term = -so3::cross<double>(xi, term) / (k + 1);
        sum += term;
    }
    return sum;
}

bool has(const KktPattern::Entries& entries, int row, int column) {
    return std::find(entries.begin(), entries.end(), std::pair(row, column)) != entries.end();
}

}  // namespace

class StepEquationsTest : public QObject {
    Q_OBJECT
    const System body_ = bodyOf("rigid-body");

private slots:
    void everyFamilyHasAnEntry() {
        QCOMPARE(stepEquations().size(), families().size());
        for (const Family& family : families())
            QVERIFY(std::any_of(stepEquations().begin(), stepEquations().end(),
                                [&](const StepEquations& e) { return e.family == family.item.id; }));
    }
    /// What stands in place of a part is said wherever there is none.
    void whatAFamilyLacksHasAReason() {
        for (const StepEquations& e : stepEquations()) {
            const auto isSaid = [](const auto& part) { return part.make || std::string(part.instead) != ""; };
            QVERIFY2(isSaid(e.matrix) && isSaid(e.functions) && isSaid(e.spaceFunctions) &&
                         (e.coordinates.make || isSaid(e.actions)),
                     e.family.c_str());
        }
    }

    void theMatrixOfABodyIsThatOfItsAction() {
        const Discretization lie = *namedScheme("lie-2");
        const State start = turning(0.4, -0.7, 1.1);
        const double h = 0.2;
        const KktPattern p = kktPattern(body_, lie, start, h);
        QVERIFY2(p.failure.empty(), p.failure.c_str());
        QCOMPARE(p.size, 3 + 9 + 3);
        // The curve of the scheme at its three Lobatto points, in the chart at the start.
        const auto integrator = makeIntegrator(body_, lie, Clock{0, h});
        State state = start, middle = start;
        QCOMPARE(advance(*integrator, state).outcome, Outcome::converged);
        integrator->denseOutput(0.5, middle.x);
        middle.t = h / 2;
        const LocalCoordinates local = *localCoordinates(body_, start);
        Eigen::VectorXd z(9);
        z << local.position(start), local.position(middle), local.position(state);
        QVERIFY(z.head(3).norm() == 0 && z.tail(3).norm() > 0.01);
        const Rule<double> gauss2 = gauss<double>(2);
        const Eigen::Vector3d inertia(body_.body().inertia.data());
        const auto S = [&](const Eigen::VectorXd& x) {
            double sum = 0;
            for (int i = 0; i < 2; ++i) {
                const double c = gauss2.c[static_cast<std::size_t>(i)];
                const double value[] = {(2 * c - 1) * (c - 1), 4 * c * (1 - c), c * (2 * c - 1)},
                             slope[] = {4 * c - 3, 4 - 8 * c, 4 * c - 1};
                Eigen::Vector3d xi = Eigen::Vector3d::Zero(), v = xi;
                for (int a = 0; a < 3; ++a) {
                    xi += value[a] * x.segment<3>(3 * a);
                    v += slope[a] / h * x.segment<3>(3 * a);
                }
                const Eigen::Vector3d eta = rateOf(xi, v);
                sum += h * gauss2.b[static_cast<std::size_t>(i)] / 2 * eta.dot(inertia.cwiseProduct(eta));
            }
            return sum;
        };
        const Eigen::MatrixXd H = hessianOf(S, z);
        const StepMatrix made = equationsOf(lie).matrix.make({body_, lie, start, h});
        const Eigen::MatrixXd own = made.magnitude.block(3, 3, 9, 9);
        QVERIFY((own - H.cwiseAbs()).cwiseAbs().maxCoeff() < 1e-4 * own.maxCoeff());
        for (int i = 0; i < 9; ++i)
            for (int j = 0; j < 9; ++j)
                QCOMPARE(has(p.action, 3 + i, 3 + j), std::abs(H(i, j)) > 1e-5 * own.maxCoeff());
    }
    /// About a principal axis the components do not couple but by precession: the third axis stands alone.
    void aPrincipalAxisLeavesHoles() {
        const KktPattern p = kktPattern(body_, *namedScheme("lie-1"), turning(0, 0, 1), 0.1);
        QVERIFY(!has(p.action, 3, 5) && !has(p.action, 5, 6));
        QVERIFY(has(p.action, 5, 8) && has(p.action, 3, 7));
    }
    /// L = T of a free body, and T is constant: the exact action is E h.
    void theActionOfAFreeBodyIsItsEnergyTimesTheStep() {
        const State start = turning(0.4, -0.7, 1.1);
        const double energy = energyOf(body_)(0, start.x.data());
        ExactActions exact(body_, start, 0.8);
        for (int i = 0; i < 6; ++i) {
            const ExactActions::Entry known = exact.at(i, {});
            QVERIFY(known.isKnown);
            QVERIFY(std::abs(known.action / (energy * known.h) - 1) < 2e-14);
        }
        for (int s = 1; s <= 3; ++s) {
            const Discretization lie = *namedScheme("lie-" + std::to_string(s));
            const ActionDefect d = actionDefect(body_, lie, 0, exact, {});
            qInfo("Lie group Gauss of degree %d: slope %.3f", s, d.order);
            QVERIFY(std::abs(d.order - (2 * s + 1)) < 0.1);
        }
    }
    /// A body with a potential, and one that moves: the order plus one, of every degree.
    void bodiesInPotentialsHaveTheOrderPlusOne() {
        for (const char* preset : {"heavy-top", "satellite"}) {
            const ReadScene read = readScene(findPreset(preset)->json);
            const System& system = *read.resolved->system;
            ExactActions exact(system, read.resolved->initial, 0.4);
            for (int s = 1; s <= 2; ++s) {
                const ActionDefect d =
                    actionDefect(system, *namedScheme("lie-" + std::to_string(s)), 0, exact, {});
                qInfo("%s, degree %d: slope %.3f", preset, s, d.order);
                QVERIFY(std::abs(d.order - (2 * s + 1)) < 0.1);
            }
        }
    }

    /// Of the trapezoidal rule a cell couples values along its sides, of an exact rule across as well; each
    /// value inside is in 4 cells and has 8 neighbours there (Leok 2004, sec. 2.1).
    void theMatrixOfASlabIsThatOfItsCells() {
        const System field = makeField({.cells = 8});
        State start{0, 0, std::vector<double>(16, 0)};
        for (std::size_t i = 0; i < 8; ++i)
            start.x[i] = std::cos(2 * fields::pi * static_cast<double>(i) / 8);
        for (const auto& [name, perCell] : {std::pair{"trapezoid", 12}, std::pair{"exact", 16}}) {
            const Discretization d = tents(rule(name), rule(name));
            const KktPattern p = kktPattern(field, d, start, 0.3);
            QVERIFY2(p.failure.empty(), p.failure.c_str());
            QCOMPARE(p.elements, 8);
            QCOMPARE(p.action.size(), static_cast<std::size_t>(8 * perCell));
            QCOMPARE(p.termsAtNode, 4);
            QCOMPARE(p.othersAtNode, 8);
            // Values at both ends in time, and 2 levels at each of 8 joints, one of them around the circle.
            QCOMPARE(p.size, 8 + 8 * 4 + 8 * 2 + 8);
            QCOMPARE(p.continuity.size(), std::size_t(2 * (8 + 8 * 2 * 2 + 8)));
            for (const KktPattern::Entries* entries : {&p.action, &p.continuity})
                for (const auto& [i, j] : *entries) QVERIFY(has(*entries, j, i));
        }
    }
    /// A nonlinear field with held ends, quadratic in both directions, against differences of the action of a
    /// cell.
    void theMatrixOfANonlinearSlabIsThatOfItsAction() {
        const System field = makeField(
            {.potential = "sine-gordon", .length = 4, .cells = 4, .boundary = "dirichlet", .degree = 2});
        const Discretization d = tents(rule("gauss", 3), rule("gauss", 2), 2, 2);
        State start{0, 0, std::vector<double>(18, 0)};
        for (std::size_t i = 0; i < 9; ++i) start.x[i] = std::sin(fields::pi * static_cast<double>(i) / 8);
        const double h = 0.3;
        const StepMatrix made = equationsOf(d).matrix.make({field, d, start, h});
        QVERIFY2(made.failure.empty(), made.failure.c_str());
        // At both ends nothing moves: the values of the first cell at its first node are those of the start.
        const UnknownBlock* second = nullptr;
        for (const UnknownBlock& b : made.blocks)
            if (!b.isMultiplier && b.index == 1) second = &b;
        QVERIFY(second && second->size == 9);
        const auto form = spatialForm(d, field.part<ScalarField>().problem);
        const auto integrator = makeIntegrator(field, d, Clock{0, h});
        State after = start;
        QCOMPARE(advance(*integrator, after).outcome, Outcome::converged);
        const auto levels = slabLevels(*form, timeTable(d), h, start.x.data(), after.x.data());
        QVERIFY(levels);
        Eigen::VectorXd z(9);
        for (int l = 0; l < 3; ++l)
            for (int a = 0; a < 3; ++a) z(3 * l + a) = (*levels)[static_cast<std::size_t>(9 * l + 2 + a)];
        const auto S = [&](const Eigen::VectorXd& x) {
            const Rule<double> inSpace = gauss<double>(3), inTime = gauss<double>(2);
            const auto phi = [](double c, int a) {
                return a == 0 ? (2 * c - 1) * (c - 1) : a == 1 ? 4 * c * (1 - c) : c * (2 * c - 1);
            };
            const auto slope = [](double c, int a) {
                return a == 0 ? 4 * c - 3 : a == 1 ? 4 - 8 * c : 4 * c - 1;
            };
            double sum = 0;
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t j = 0; j < 2; ++j) {
                    double u = 0, ux = 0, ut = 0;
                    for (int l = 0; l < 3; ++l)
                        for (int a = 0; a < 3; ++a) {
                            const double value = x(3 * l + a), c = inSpace.c[i], tau = inTime.c[j];
                            u += phi(c, a) * phi(tau, l) * value;
                            ux += slope(c, a) * phi(tau, l) * value;
                            ut += phi(c, a) * slope(tau, l) / h * value;
                        }
                    sum += h * inSpace.b[i] * inTime.b[j] * (ut * ut / 2 - ux * ux / 2 - (1 - std::cos(u)));
                }
            return sum;
        };
        const Eigen::MatrixXd H = hessianOf(S, z);
        const Eigen::MatrixXd own = made.magnitude.block(second->offset, second->offset, 9, 9);
        QVERIFY((own - H.cwiseAbs()).cwiseAbs().maxCoeff() < 1e-5 * own.maxCoeff());
    }
    /// A wave of the mesh is an oscillator: q'' = -W^2 q, mass L/2, whose action from rest is
    /// -(mass W A^2 / 4) sin 2 W h.
    void theActionOfAHarmonicStringIsKnown() {
        constexpr int cells = 12;
        const System field = makeField({.cells = cells});
        State start{0, 0, std::vector<double>(2 * cells, 0)};
        const double dx = 2 * fields::pi / cells;
        for (std::size_t i = 0; i < cells; ++i) start.x[i] = 0.7 * std::cos(static_cast<double>(i) * dx);
        const double W = 2 / dx * std::sin(dx / 2), mass = fields::pi;
        for (const auto& [time, degree, slope] :
             {std::tuple{rule("trapezoid"), 1, 3}, std::tuple{rule("midpoint"), 1, 3},
              std::tuple{rule("gauss", 2), 2, 5}, std::tuple{rule("lobatto", 3), 2, 5}}) {
            const Discretization d = tents(rule("trapezoid"), time, 1, degree);
            const StepCase step{field, d, start, 0.8};
            const auto pair = equationsOf(d).actions.make(step)(0.8, {});
            QVERIFY(pair);
            const double known = -mass * W * 0.49 / 4 * std::sin(2 * W * 0.8);
            QVERIFY2(std::abs(pair->exact - known) < 1e-13, qPrintable(QString::number(pair->exact - known)));
            const ActionDefect defect = actionDefect(step, {});
            qInfo("%s of degree %d: slope %.3f", time.type.c_str(), degree, defect.order);
            QVERIFY(std::abs(defect.order - slope) < 0.1);
            QCOMPARE(equationsOf(d).orderInTime(d) + 1, slope);
        }
    }

    /// cos x has two harmonics: each mode meets its two neighbours, and the last two modes each other around
    /// the corner.
    void theMatrixOfAWaveIsItsPotential() {
        const ReadScene read = readScene(std::string_view(
            R"~({"extremal": 1, "model": {"type": "schrodinger", "potential": "cos(x)", "modes": 16,
                "domain": [0, 6.283185307179586]},
                "initial": {"psi": {"packet": "gaussian", "centre": 3, "width": 0.5, "wave_number": 0}}, "time": {"end": 1},
                "schemes": [{"label": "one", "scheme": "schrodinger-gauss-1", "step": 0.1},
                            {"label": "two", "scheme": "schrodinger-gauss-2", "step": 0.1}],
                "views": ["sparsity"]})~"));
        QVERIFY2(read.errors.empty(), read.errors.empty() ? "" : read.errors[0].message.c_str());
        const Comparison c = run(read.scene);
        for (std::size_t s = 0; s < 2; ++s) {
            const KktPattern& p = *c.schemes[s]->products.find<KktPattern>();
            const int stages = static_cast<int>(s) + 1;
            QCOMPARE(p.size, 16 * stages);
            QCOMPARE(p.action.size(), static_cast<std::size_t>(3 * 16 * stages * stages));
            for (const auto& [i, j] : p.action) {
                const int distance = std::abs(i % 16 - j % 16);
                QVERIFY(distance <= 1 || distance == 15);
            }
            const Figure figure = makeFigure(c, plotViews(c.scene)[s]);
            QVERIFY(figure.title.starts_with("Matrix of a step of "));
            QVERIFY(figure.subtitle.starts_with("16 of 16 modes"));
        }
    }

    /// Of the midpoint rule, S = (z_1 - z_0)^2 / (2 h) - h ((z_0 + z_1) / 2)^2 / 2 on the oscillator.
    void theLengthOfAStepHasARowOfItsOwn() {
        const ReadScene read = readScene(std::string(findPreset("oscillator-sem")->json));
        const System& system = *read.resolved->system;
        const Discretization d = *namedScheme("sem-1");
        const State start = read.resolved->initial;
        const double h = 0.1, mass = 1, k = 1;
        const StepMatrix m = equationsOf(d).matrix.make({system, d, start, h});
        QVERIFY2(m.failure.empty(), m.failure.c_str());
        QCOMPARE(m.magnitude.rows(), Eigen::Index(1 + 2 + 1 + 1));
        const double z0 = start.x[0], middle = (z0 + h / 2 * start.x[1] / mass) / (1 + h * h / 4 * k / mass),
                     z1 = 2 * middle - z0;
        QVERIFY(std::abs(m.magnitude(1, 4) - std::abs((z1 - z0) / (h * h) - (z0 + z1) / 4)) < 1e-10);
        QVERIFY(std::abs(m.magnitude(2, 4) - std::abs((z1 - z0) / (h * h) + (z0 + z1) / 4)) < 1e-10);
        QVERIFY(std::abs(m.magnitude(4, 4) - (z1 - z0) * (z1 - z0) / (h * h * h)) < 1e-10);
        QVERIFY(m.magnitude(0, 4) == 0 && m.magnitude(3, 4) == 0);
        // Of a given length its action is that of any Galerkin element.
        ExactActions exact(system, start, 1);
        const ActionDefect own = actionDefect(system, d, 0, exact, {}),
                           midpoint = actionDefect(system, *namedScheme("midpoint"), 0, exact, {});
        QVERIFY(own.defect == midpoint.defect && std::abs(own.order - 3) < 0.1);
    }
    /// d2 L_d / dz_0 dz_1 of nodes that move, by differences of the action of two elements.
    void theMatrixOfMovingNodesIsThatOfTheirAction() {
        const ReadScene read = readScene(std::string(findPreset("moving-mesh-cost")->json));
        const ResolvedScheme* moving = nullptr;
        for (const ResolvedScheme& s : read.resolved->schemes)
            if (s.plain() && equationsOf(*s.plain()).family == "moving_mesh" && s.isFixed()) moving = &s;
        QVERIFY(moving);
        const System& system = *moving->ownSystem;
        const State& start = moving->ownInitial;
        const double h = moving->spec.step.value;
        const StepMatrix m = equationsOf(*moving->plain()).matrix.make({system, *moving->plain(), start, h});
        QVERIFY2(m.failure.empty(), m.failure.c_str());
        const auto integrator = moving->make(system, h, start);
        State after = start;
        QCOMPARE(advance(*integrator, after).outcome, Outcome::converged);
        const std::size_t n = start.x.size() / 4, e = n / 2;
        const double c2 = system.fieldProblem().elastic.k;
        // z of three nodes at both ends, (y, X) one after the other: what the middle one is in.
        Eigen::VectorXd z(12);
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t node = e - 1 + i;
            const auto at = static_cast<Eigen::Index>(2 * i);
            z(at) = start.x[node];
            z(at + 1) = start.x[2 * n + node];
            z(at + 6) = after.x[node];
            z(at + 7) = after.x[2 * n + node];
        }
        const auto S = [&](const Eigen::VectorXd& x) {
            const Rule<double> rule = gauss<double>(4);
            double sum = 0;
            for (int k = 0; k < 2; ++k) {
                const auto middle = [&](int i) { return (x(2 * k + i) + x(2 * k + i + 6)) / 2; };
                const auto rate = [&](int i) { return (x(2 * k + i + 6) - x(2 * k + i)) / h; };
                const double size = middle(3) - middle(1), slope = (middle(2) - middle(0)) / size,
                             r0 = rate(0) - slope * rate(1), r1 = rate(2) - slope * rate(3);
                double W = 0;
                for (int q = 0; q < 4; ++q) {
                    const double u =
                        middle(0) + rule.c[static_cast<std::size_t>(q)] * (middle(2) - middle(0));
                    W += rule.b[static_cast<std::size_t>(q)] * (1 - std::cos(u));
                }
                sum += h * size * ((r0 * r0 + r0 * r1 + r1 * r1) / 6 - c2 * slope * slope / 2 - W);
            }
            return sum;
        };
        const Eigen::MatrixXd H = hessianOf(S, z);
        const auto row = static_cast<Eigen::Index>(2 * e);
        const Eigen::MatrixXd own = m.magnitude.block(row, row - 2, 2, 6),
                              known = H.block(2, 6, 2, 6).cwiseAbs();
        QVERIFY2((own - known).cwiseAbs().maxCoeff() < 1e-3 * known.maxCoeff(),
                 qPrintable(QString::number((own - known).cwiseAbs().maxCoeff() / known.maxCoeff())));
    }
    /// Values meet their two neighbours; where knots are free, values and places meet both.
    void theHessianOfAProfileKnowsWhatIsFree() {
        const ReadScene read = readScene(std::string(findPreset("free-knots")->json),
                                         {{"/views", Value::Array{Value("sparsity")}}});
        QVERIFY(read.errors.empty());
        const Comparison c = run(read.scene);
        for (const auto& scheme : c.schemes) {
            const KktPattern& p = *scheme->products.find<KktPattern>();
            QVERIFY2(p.failure.empty(), p.failure.c_str());
            const bool isFree = scheme->scheme->discretization.space.text("place") == "free";
            const int each = isFree ? 2 : 1, knots = p.size / each;
            QCOMPARE(p.size, each * (p.elements - 1));
            QVERIFY(p.bandwidth <= 2 * each - 1);
            QVERIFY(p.action.size() <= static_cast<std::size_t>(each * each * (3 * knots - 2)));
            QVERIFY(p.action.size() >= static_cast<std::size_t>(each * (3 * knots - 2)) - 4);
            const Trajectory& rows = scheme->trajectory;
            const std::vector<double> x(rows[rows.columns[0].name].begin(), rows[rows.columns[0].name].end()),
                u(rows["u"].begin(), rows["u"].end());
            QCOMPARE(static_cast<int>(x.size()), knots + 2);
            const System& system = *read.resolved->system;
            const StaticProblem& problem = *system.part<StaticPart>().problem;
            // The energy of all elements, of the values and places of the knots inside.
            Eigen::VectorXd z(p.size);
            for (int k = 0; k < knots; ++k) {
                const auto at = static_cast<std::size_t>(k + 1);
                z(each * k) = u[at];
                if (isFree) z(2 * k + 1) = x[at];
            }
            const auto E = [&](const Eigen::VectorXd& w) {
                double sum = 0;
                const auto value = [&](int k, int i) {
                    const auto at = static_cast<std::size_t>(k);
                    if (k == 0 || k == knots + 1 || (i == 1 && !isFree)) return i == 0 ? u[at] : x[at];
                    return w(each * (k - 1) + i);
                };
                for (int k = 0; k <= knots; ++k) {
                    const double ends[] = {value(k, 0), value(k, 1), value(k + 1, 0), value(k + 1, 1)};
                    sum += staticElement(problem, ends).energy;
                }
                return sum;
            };
            const StepMatrix m =
                equationsOf(*scheme->scheme->plain())
                    .matrix.make({*systemOf(*read.resolved, *scheme->scheme), *scheme->scheme->plain(),
                                  initialOf(*read.resolved, *scheme->scheme), scheme->spec.step.value});
            const Eigen::MatrixXd H = hessianOf(E, z, 1e-5).cwiseAbs();
            QVERIFY2((m.magnitude - H).cwiseAbs().maxCoeff() < 1e-3 * H.maxCoeff(),
                     qPrintable(QString::number((m.magnitude - H).cwiseAbs().maxCoeff() / H.maxCoeff())));
        }
    }

    void functionsOfSpaceAndTime() {
        for (const auto& [preset, count] :
             {std::pair{"klein-gordon", std::size_t(2)}, std::pair{"coherent-state", std::size_t(4)},
              std::pair{"elliptic", std::size_t(1)}}) {
            const ReadScene read =
                readScene(findPreset(preset)->json,
                          {{"/views", parseJson(R"([{"view": "basis", "direction": "space"}])")}});
            QVERIFY2(read.errors.empty(), preset);
            const Comparison c = run(read.scene);
            const Figure figure = makeFigure(c, plotViews(read.scene)[0]);
            std::size_t curves = 0;
            for (const Series& s : figure.series()) curves += hasLine(s.kind) ? 1 : 0;
            QCOMPARE(curves, count);
        }
        // Hats are 1 at a node and 0 at the other, and add to 1 in between.
        const System field = makeField({.cells = 4, .degree = 2});
        const Discretization d = tents(rule("gauss", 3), rule("gauss", 2), 2, 2);
        const State start{0, 0, std::vector<double>(16, 0)};
        const SpaceFunctions f = equationsOf(d).spaceFunctions.make({field, d, start, 0.1});
        QCOMPARE(f.curves.size(), std::size_t(3));
        for (std::size_t i = 0; i < f.curves[0].x.size(); ++i)
            QVERIFY(std::abs(f.curves[0].y[i] + f.curves[1].y[i] + f.curves[2].y[i] - 1) < 1e-14);
        const Table<double> time = equationsOf(d).functions.make({field, d, start, 0.1});
        QCOMPARE(time.nodes(), 2);
        QCOMPARE(time.space.size, 3);
    }
    /// A scene without a space asked for its functions there is told so, where it is written.
    void whatHasNoSpaceHasNoFunctionsOfIt() {
        const ReadScene read =
            readScene(findPreset("kepler")->json,
                      {{"/views", parseJson(R"([{"view": "basis", "direction": "space"}])")}});
        QCOMPARE(read.errors.size(), std::size_t(1));
        QCOMPARE(read.errors[0].pointer, std::string("/views/0"));
        QVERIFY(read.errors[0].hint.find("functions of time alone") != std::string::npos);
        // The other way round the remedy is named, and works (functionsOfSpaceAndTime).
        const ReadScene still =
            readScene(std::string(findPreset("elliptic")->json), {{"/views", Value::Array{Value("basis")}}});
        QCOMPARE(still.errors.size(), std::size_t(1));
        QVERIFY(still.errors[0].hint.starts_with("it needs \"direction\": \"space\""));
    }
};

EXTREMAL_TEST(StepEquationsTest)
}  // namespace extremal::step_equations_test

#include "step_equations_test.moc"
