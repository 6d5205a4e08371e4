// SPDX-License-Identifier: GPL-3.0-or-later
/// Tensor elements over rectangles against the discrete action itself, cell by cell: stationary levels, the
/// multisymplectic and the symplectic form, charge.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "engine/family/field/discretization.hpp"
#include "engine/model/field/element_grid.hpp"
#include "engine/quadrature/collocation.hpp"
#include "tests/engine/family/field/plane_tents.hpp"
#include "tests/tools/test.hpp"

namespace extremal::plane_tent_test {
using namespace plane_tents;
namespace {

/// One cell of space and time, degree r in space and 1 in time, as a sum over its quadrature nodes: no modes,
/// no matrices of the mesh.
struct Cells {
    const PlaneFieldProblem& problem;
    int degree;
    Rule<double> space, spaceY, time;
    double h;
    double couplingOfUV;  ///< W = (u^2 + v^2)^2/4 + coupling u v

    int along() const { return problem.grid().nx / degree; }
    int across() const { return problem.grid().ny / degree; }
    std::size_t node(int cx, int cy, int a, int b) const {
        const int nx = problem.grid().nx, ny = problem.grid().ny;
        return static_cast<std::size_t>((cx * degree + a) % nx + nx * ((cy * degree + b) % ny));
    }
    /// Values and slopes of the functions that are 1 at one of r + 1 equidistant places.
    void functions(double xi, Row& value, Row& slope) const {
        Row places;
        for (int a = 0; a <= degree; ++a) places.push_back(static_cast<double>(a) / degree);
        value = lagrangeTable(places, {xi});
        slope.assign(places.size(), 0);
        for (std::size_t a = 0; a < places.size(); ++a)
            for (std::size_t k = 0; k < places.size(); ++k) {
                if (k == a) continue;
                double product = 1 / (places[a] - places[k]);
                for (std::size_t m = 0; m < places.size(); ++m)
                    if (m != a && m != k) product *= (xi - places[m]) / (places[a] - places[m]);
                slope[a] += product;
            }
    }
    /// Calls use(node, level, c, value of dS/d of it) for a cell between two levels; with `du`, `dv` levels
    /// of a variation, the derivative of that in its direction.
    template <class Use>
    void slopes(int cx, int cy, const Row* u, const Row* du, Use&& use) const {
        const double dx = problem.grid().x.length / along(), dy = problem.grid().y.length / across();
        const std::size_t nodes = problem.nodes(), m = problem.components();
        Row px, sx, py, sy;
        for (int i = 0; i < space.size(); ++i)
            for (int j = 0; j < spaceY.size(); ++j)
                for (int q = 0; q < time.size(); ++q) {
                    functions(space.c[static_cast<std::size_t>(i)], px, sx);
                    functions(spaceY.c[static_cast<std::size_t>(j)], py, sy);
                    const double tau = time.c[static_cast<std::size_t>(q)];
                    const double weight = h * dx * dy * space.b[static_cast<std::size_t>(i)] *
                                          spaceY.b[static_cast<std::size_t>(j)] *
                                          time.b[static_cast<std::size_t>(q)];
                    struct Point {
                        double u = 0, t = 0, x = 0, y = 0;
                    };
                    const auto at = [&](const Row* levels, std::size_t c) {
                        Point p;
                        for (int a = 0; a <= degree; ++a)
                            for (int b = 0; b <= degree; ++b)
                                for (int l = 0; l < 2; ++l) {
                                    const auto A = static_cast<std::size_t>(a),
                                               B = static_cast<std::size_t>(b);
                                    const double z = levels[l][c * nodes + node(cx, cy, a, b)],
                                                 psi = l == 0 ? 1 - tau : tau, dpsi = (l == 0 ? -1 : 1) / h;
                                    p.u += z * psi * px[A] * py[B];
                                    p.t += z * dpsi * px[A] * py[B];
                                    p.x += z * psi * sx[A] / dx * py[B];
                                    p.y += z * psi * px[A] * sy[B] / dy;
                                }
                        return p;
                    };
                    std::vector<Point> is, moved;
                    for (std::size_t c = 0; c < m; ++c) {
                        is.push_back(at(u, c));
                        if (du) moved.push_back(at(du, c));
                    }
                    for (std::size_t c = 0; c < m; ++c) {
                        const double other = m > 1 ? is[1 - c].u : 0, own = is[c].u;
                        double force = (own * own + other * other) * own + couplingOfUV * other;
                        Point p = is[c];
                        if (du) {
                            const double w = m > 1 ? moved[1 - c].u : 0;
                            p = moved[c];
                            force =
                                (3 * own * own + other * other) * p.u + (2 * own * other + couplingOfUV) * w;
                        }
                        const double k = problem.stiffness(c);
                        for (int a = 0; a <= degree; ++a)
                            for (int b = 0; b <= degree; ++b)
                                for (int l = 0; l < 2; ++l) {
                                    const auto A = static_cast<std::size_t>(a),
                                               B = static_cast<std::size_t>(b);
                                    const double psi = l == 0 ? 1 - tau : tau, dpsi = (l == 0 ? -1 : 1) / h;
                                    use(node(cx, cy, a, b), l, c,
                                        weight *
                                            (p.t * dpsi * px[A] * py[B] -
                                             k * psi * (p.x * sx[A] / dx * py[B] + p.y * px[A] * sy[B] / dy) -
                                             force * psi * px[A] * py[B]));
                                }
                    }
                }
    }
};

const char* const coupled = "(u^2 + v^2)^2/4 + 0.3*u*v";

struct RulePair {
    const char* name;
    int degree;
    Settings space, time;
    Settings across = {};  ///< without a type: as in space

    Discretization discretization() const {
        const Discretization d = tents(space, time, degree);
        return across.type.empty() ? d : withAcross(d, across);
    }
};
const std::vector<RulePair>& rulePairs() {
    static const std::vector<RulePair> pairs = {
        {"trapezoid x trapezoid", 1, trapezoid(), trapezoid()},
        {"Gauss 2 x trapezoid", 1, gauss2(), trapezoid()},
        {"Gauss 2 x Gauss 2", 1, gauss2(), gauss2()},
        {"trapezoid x midpoint", 1, trapezoid(), midpoint()},
        {"degree 2, Lobatto 3 x trapezoid", 2, lobattoOf(3), trapezoid()},
        {"degree 2, Gauss 3 x midpoint", 2, gaussOf(3), midpoint()},
        {"degree 3, Gauss 4 x trapezoid", 3, gaussOf(4), trapezoid()},
        {"trapezoid, Gauss 2 along y x trapezoid", 1, trapezoid(), trapezoid(), gauss2()},
        {"degree 2, Gauss 4, Lobatto 3 along y x midpoint", 2, gaussOf(4), midpoint(), lobattoOf(3)}};
    return pairs;
}

/// Two unlike components with unlike speeds on cells of unlike sides.
struct CoupledCase {
    static constexpr double h = 0.04;
    System system = plane(coupled, {0, 3, 12}, {0, 5, 12}, {"u", "v"}, Value::Array{1.0, 1.3});
    Discretization d;
    std::unique_ptr<Integrator> integrator;
    Cells cells;

    explicit CoupledCase(int index) : CoupledCase(rulePairs()[static_cast<std::size_t>(index)]) {}
    explicit CoupledCase(const RulePair& pair)
        : d(pair.discretization()),
          integrator(makeIntegrator(system, d, {0, h})),
          cells{problemOf(system),
                pair.degree,
                ruleIn(d.quadrature, "space", pair.degree),
                ruleIn(d.quadrature, acrossPart, pair.degree),
                ruleIn(d.quadrature, "time", 1),
                h,
                0.3} {}
};

void addRulePairs() {
    QTest::addColumn<int>("index");
    for (std::size_t i = 0; i < rulePairs().size(); ++i)
        QTest::newRow(rulePairs()[i].name) << static_cast<int>(i);
}

}  // namespace

class PlaneTentTest : public QObject {
    Q_OBJECT
private slots:
    /// The levels of a run are stationary for the sum over all cells.
    void levelsAreStationary_data() { addRulePairs(); }
    void levelsAreStationary() {
        QFETCH(int, index);
        const CoupledCase made(index);
        const Cells& cells = made.cells;
        const PlaneFieldProblem& problem = cells.problem;
        std::vector<Row> levels;
        State state = random(made.system, 0.5, 7);
        for (int k = 0; k < 4; ++k) {
            levels.push_back(state.x);
            QCOMPARE(advance(*made.integrator, state).outcome, Outcome::converged);
        }
        Row sum(problem.size(), 0), terms(problem.size(), 0);
        for (int l = 1; l < 3; ++l)
            for (int slab = l - 1; slab <= l; ++slab)
                for (int cx = 0; cx < cells.along(); ++cx)
                    for (int cy = 0; cy < cells.across(); ++cy)
                        cells.slopes(cx, cy, &levels[static_cast<std::size_t>(slab)], nullptr,
                                     [&](std::size_t node, int level, std::size_t c, double value) {
                                         if (slab + level != l) return;
                                         sum[c * problem.nodes() + node] += value;
                                         terms[c * problem.nodes() + node] += std::abs(value);
                                     });
        const double size = *std::max_element(terms.begin(), terms.end());
        double most = 0;
        for (const double each : sum) most = std::max(most, std::abs(each) / size);
        qInfo("%.1e", most);
        QVERIFY(most < 1e-12);
    }
    /// Two variations, moved by the tangent map, on a box of 2 x 3 or more cells and three slabs.
    void formOverTheBoundaryOfABox_data() { addRulePairs(); }
    void formOverTheBoundaryOfABox() {
        QFETCH(int, index);
        const CoupledCase made(index);
        const Cells& cells = made.cells;
        const PlaneFieldProblem& problem = cells.problem;
        const std::size_t n = problem.size(), slabs = 3;
        State state = random(made.system, 0.5, 11);
        std::mt19937 generator(2);
        std::uniform_real_distribution<double> uniform(-1, 1);
        Row both(4 * n);
        for (double& each : both) each = uniform(generator);
        std::vector<Row> levels{state.x}, first{Row(both.begin(), both.begin() + static_cast<long>(n))},
            second{Row(both.begin() + static_cast<long>(2 * n), both.begin() + static_cast<long>(3 * n))};
        for (std::size_t k = 0; k < slabs; ++k) {
            QCOMPARE(advance(*made.integrator, state).outcome, Outcome::converged);
            QVERIFY(made.integrator->applyTangent(both));
            levels.push_back(state.x);
            first.emplace_back(both.begin(), both.begin() + static_cast<long>(n));
            second.emplace_back(both.begin() + static_cast<long>(2 * n),
                                both.begin() + static_cast<long>(3 * n));
        }
        // Sums of H V and H W over the cells of the box, at each of its nodes and levels.
        std::vector<Row> ofFirst(slabs + 1, Row(n, 0)), ofSecond = ofFirst;
        std::vector<std::vector<char>> isOnBoundary(slabs + 1, std::vector<char>(problem.nodes(), 0)),
            isIn = isOnBoundary;
        const int wide = cells.along() - 1, high = cells.across() - 2;
        for (int cx = 0; cx < wide; ++cx)
            for (int cy = 0; cy < high; ++cy)
                for (std::size_t k = 0; k < slabs; ++k)
                    for (auto* to : {&ofFirst, &ofSecond})
                        cells.slopes(cx, cy, &levels[k], to == &ofFirst ? &first[k] : &second[k],
                                     [&](std::size_t node, int level, std::size_t c, double value) {
                                         const std::size_t l = k + static_cast<std::size_t>(level);
                                         (*to)[l][c * problem.nodes() + node] += value;
                                         const int x = static_cast<int>(node) % problem.grid().nx,
                                                   y = static_cast<int>(node) / problem.grid().nx;
                                         isIn[l][node] = 1;
                                         isOnBoundary[l][node] = l == 0 || l == slabs || x == 0 || y == 0 ||
                                                                 x == wide * cells.degree ||
                                                                 y == high * cells.degree;
                                     });
        double sum = 0, terms = 0, inside = 0;
        for (std::size_t l = 0; l <= slabs; ++l)
            for (std::size_t i = 0; i < n; ++i) {
                const double a = ofFirst[l][i] * second[l][i], b = ofSecond[l][i] * first[l][i];
                if (isOnBoundary[l][i % problem.nodes()]) {
                    sum += a - b;
                    terms += std::abs(a) + std::abs(b);
                } else if (isIn[l][i % problem.nodes()]) {
                    inside += std::abs(a) + std::abs(b);
                }
            }
        qInfo("%.1e; inside %.1e", std::abs(sum) / terms, inside / terms);
        QVERIFY(terms > 0 && std::abs(sum) < 1e-13 * terms);
        QVERIFY(inside < 1e-12 * terms);
    }
    void chargeIsKeptByEveryRule_data() { addRulePairs(); }
    void chargeIsKeptByEveryRule() {
        QFETCH(int, index);
        const RulePair& pair = rulePairs()[static_cast<std::size_t>(index)];
        const auto change = [&](const char* potential) {
            const System system = plane(potential, {0, 3, 12}, {0, 5, 12});
            const State start = random(system, 0.5, 3);
            const Discretization d = pair.discretization();
            State end = run(system, d, start, 0.04, 50);
            // u M v_t - v M u_t, of these elements and not of the trigonometric polynomial.
            const PlaneFieldProblem& problem = problemOf(system);
            const auto charge = [&](const State& state) {
                const std::size_t n = problem.nodes();
                ElementGrid grid({12, pair.degree, 3}, {12, pair.degree, 5},
                                 ruleIn(d.quadrature, "space", pair.degree),
                                 ruleIn(d.quadrature, acrossPart, pair.degree));
                std::vector<Row> modes(4, Row(n));
                for (std::size_t k = 0; k < 4; ++k) grid.toModes(state.x.data() + k * n, modes[k].data());
                double sum = 0;
                for (std::size_t i = 0; i < n; ++i)
                    sum += modes[0][i] * modes[3][i] - modes[1][i] * modes[2][i];
                return sum;
            };
            return std::abs(charge(end) - charge(start));
        };
        const double kept = change("(u^2 + v^2)^2/4"), lost = change("(u^2 + 2*v^2)^2/4");
        qInfo("%.1e; of components of unlike W %.1e", kept, lost);
        QVERIFY(kept < 1e-12 && lost > 1e-4);
    }
    void theStepIsSymplectic_data() { addRulePairs(); }
    void theStepIsSymplectic() {
        QFETCH(int, index);
        const CoupledCase made(index);
        State state = random(made.system, 0.5, 9);
        const std::size_t n = made.cells.problem.size();
        std::mt19937 generator(4);
        std::uniform_real_distribution<double> uniform(-1, 1);
        Row both(4 * n);
        for (double& each : both) each = uniform(generator);
        const auto form = [&] {
            double sum = 0, terms = 0;
            for (std::size_t i = 0; i < n; ++i) {
                const double a = both[i] * both[3 * n + i], b = both[n + i] * both[2 * n + i];
                sum += a - b;
                terms += std::abs(a) + std::abs(b);
            }
            return std::pair{sum, terms};
        };
        const double before = form().first;
        for (int k = 0; k < 20; ++k) {
            QCOMPARE(advance(*made.integrator, state).outcome, Outcome::converged);
            QVERIFY(made.integrator->applyTangent(both));
        }
        const auto [after, terms] = form();
        qInfo("%.1e", std::abs(after - before) / terms);
        QVERIFY(std::abs(after - before) < 1e-13 * terms);
    }
};

EXTREMAL_TEST(PlaneTentTest)

}  // namespace extremal::plane_tent_test

#include "plane_tent_test.moc"
