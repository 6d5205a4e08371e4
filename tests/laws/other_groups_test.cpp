// SPDX-License-Identifier: GPL-3.0-or-later
/// Groups, products, spheres and spins of kinds that no preset has, against codes of their own: equations
/// written by hand, in matrices or in Cartesian coordinates, by the Runge-Kutta-Fehlberg method of order 8.
#include <QTest>

#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include <Eigen/Geometry>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/model/spins/spins.hpp"
#include "tests/laws/matrix_groups.hpp"
#include "tests/tools/test.hpp"

namespace extremal::other_groups_test {
namespace {

using namespace laws;
using List = std::vector<double>;
using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;
using Three = Eigen::Vector3d;
using Rates = std::function<void(const List& y, List& dy, double t)>;

List integrated(const Rates& rates, List y, double duration) {
    boost::numeric::odeint::runge_kutta_fehlberg78<List> stepper;
    constexpr int steps = 4000;
    for (int k = 0; k < steps; ++k) stepper.do_step(rates, y, k * duration / steps, duration / steps);
    return y;
}

Value valueOf(const Matrix& m) {
    Value::Array rows;
    for (Eigen::Index i = 0; i < m.rows(); ++i) {
        Value::Array row;
        for (Eigen::Index j = 0; j < m.cols(); ++j) row.emplace_back(m(i, j));
        rows.emplace_back(row);
    }
    return rows;
}
Value basisOf(const std::vector<Matrix>& basis) {
    Value::Array all;
    for (const Matrix& E : basis) all.push_back(valueOf(E));
    return Value::Object{{"basis", all}};
}
Matrix unit(int n, int i, int j) {
    Matrix m = Matrix::Zero(n, n);
    m(i, j) = 1;
    return m;
}

/// g' = g hat(xi), mu' = ad_xi^T mu + f, from commutators of matrices and least squares; the Lagrangian by
/// hand: momenta m(xi), from which xi is found by Newton's method with differences, and -dU/dg.
struct ByHand {
    std::vector<Matrix> basis;
    std::function<Vector(const Vector& xi)> momenta;
    std::function<Matrix(const Matrix& g)> slope;  ///< dU/dg_ij

    Matrix hat(const Vector& xi) const {
        Matrix X = Matrix::Zero(basis[0].rows(), basis[0].cols());
        for (std::size_t k = 0; k < basis.size(); ++k) X += xi(static_cast<Eigen::Index>(k)) * basis[k];
        return X;
    }
    Vector coordinates(const Matrix& X) const {
        Matrix columns(X.size(), static_cast<Eigen::Index>(basis.size()));
        for (std::size_t k = 0; k < basis.size(); ++k)
            columns.col(static_cast<Eigen::Index>(k)) = basis[k].reshaped();
        return columns.colPivHouseholderQr().solve(Vector(X.reshaped()));
    }
    Vector velocity(const Vector& mu, Vector xi) const {
        for (int iteration = 0; iteration < 20; ++iteration) {
            const Vector miss = momenta(xi) - mu;
            if (miss.norm() < 1e-15 * (1 + mu.norm())) break;
            Matrix J(mu.size(), mu.size());
            for (Eigen::Index k = 0; k < mu.size(); ++k) {
                const Vector step = 1e-5 * Vector::Unit(mu.size(), k);
                J.col(k) = (momenta(xi + step) - momenta(xi - step)) / 2e-5;
            }
            xi -= J.partialPivLu().solve(miss);
        }
        return xi;
    }
    /// (g row by row, mu) after a time, from the identity.
    List end(const Vector& xi0, double duration) const {
        const Eigen::Index n = basis[0].rows(), d = static_cast<Eigen::Index>(basis.size());
        // Brackets once: [E_i, E_j] in coordinates.
        std::vector<Matrix> brackets;
        for (Eigen::Index i = 0; i < d; ++i) {
            Matrix c(d, d);
            for (Eigen::Index j = 0; j < d; ++j) {
                const Matrix &A = basis[static_cast<std::size_t>(i)], &B = basis[static_cast<std::size_t>(j)];
                c.col(j) = coordinates(A * B - B * A);
            }
            brackets.push_back(c);
        }
        using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
        List y(static_cast<std::size_t>(n * n + d));
        Eigen::Map<Rows>(y.data(), n, n) = Matrix::Identity(n, n);
        Eigen::Map<Vector>(y.data() + n * n, d) = momenta(xi0);
        const Rates rates = [&](const List& at, List& dy, double) {
            const Matrix g = Eigen::Map<const Rows>(at.data(), n, n);
            const Vector mu = Eigen::Map<const Vector>(at.data() + n * n, d), xi = velocity(mu, xi0);
            Eigen::Map<Rows>(dy.data(), n, n) = g * hat(xi);
            Vector rate = Vector::Zero(d);
            const Matrix S = slope(g);
            for (Eigen::Index k = 0; k < d; ++k) {
                rate += xi(k) * brackets[static_cast<std::size_t>(k)].transpose() * mu;
                rate(k) -= S.cwiseProduct(g * basis[static_cast<std::size_t>(k)]).sum();
            }
            Eigen::Map<Vector>(dy.data() + n * n, d) = rate;
        };
        return integrated(rates, y, duration);
    }
};

struct Slopes {
    double places = 0, momenta = 0;
    std::string row;
};
/// Over the pairs of steps before round-off; `entries`: of the state that are places.
Slopes slopesOf(const System& system, const State& start, const List& reference, std::size_t entries,
                const Discretization& scheme, double duration, int coarsest) {
    Slopes found;
    double before[2] = {0, 0};
    for (int n = coarsest; n <= 8 * coarsest; n *= 2) {
        const auto end = after(*makeIntegrator(system, scheme, {0, duration / n}), start, n);
        if (!end) {
            found.row += " failed";
            continue;
        }
        const double now[2] = {distance(end->x, reference, 0, entries),
                               distance(end->x, reference, entries, reference.size())};
        if (std::min(now[0], now[1]) < 1e-12) break;
        if (before[0] > 0) {
            found.places = std::log2(before[0] / now[0]);
            found.momenta = std::log2(before[1] / now[1]);
        }
        std::copy_n(now, 2, before);
        found.row += QString::asprintf(" %.2e/%.2e", now[0], now[1]).toStdString();
    }
    return found;
}

void checkOrders(const System& system, const State& start, const List& reference, std::size_t entries,
                 double duration, int coarsest) {
    for (int k = 2; k <= 7; ++k) {
        const int s = k / 2;
        const LieForm& form = lieForms[k % 2 == 0 ? 0 : 2];
        const Slopes made =
            slopesOf(system, start, reference, entries, lieFormed(s, form), duration, coarsest);
        qInfo("s = %d%s:%s, slopes %.2f, %.2f", s, form.name, made.row.c_str(), made.places, made.momenta);
        QVERIFY(std::abs(made.places - 2 * s) < 0.2);
        QVERIFY(made.momenta > 2 * s - 0.2);
    }
}

System groupSystem(const Value& group, const char* lagrangian, const Value& let = {}) {
    return systemNamed(
        "group",
        {{"group", group}, {"lagrangian", lagrangian}, {"parameters", Value::Object{}}, {"let", let}});
}
State startOf(const System& system, const Vector& xi) {
    Value::Array list;
    for (const double v : xi) list.emplace_back(v);
    return {0, 0, system.start(Settings{"", {{"xi", list}}, {}}, 0)};
}

/// Rotations in the planes 23, 31, 12 and boosts along 1, 2, 3, the time being the last row.
std::vector<Matrix> lorentz() {
    std::vector<Matrix> all;
    for (int k = 0; k < 3; ++k)
        all.push_back(unit(4, (k + 2) % 3, (k + 1) % 3) - unit(4, (k + 1) % 3, (k + 2) % 3));
    for (int k = 0; k < 3; ++k) all.push_back(unit(4, k, 3) + unit(4, 3, k));
    return all;
}
/// A X + X A^T = 0 for the form J of four dimensions.
std::vector<Matrix> symplectic() {
    std::vector<Matrix> all;
    Matrix J = Matrix::Zero(4, 4);
    J.topRightCorner(2, 2).setIdentity();
    J.bottomLeftCorner(2, 2) = -Matrix::Identity(2, 2);
    for (int i = 0; i < 4; ++i)
        for (int j = i; j < 4; ++j) all.push_back(J * (unit(4, i, j) + unit(4, j, i)) / 2);
    return all;
}

}  // namespace

class OtherGroupsTest : public QObject {
    Q_OBJECT

private slots:
    /// SO(3,1), with a kinetic energy that is not quadratic, in a potential.
    void lorentzGroup() {
        const double I[] = {1, 1.5, 2, 1.2, 0.8, 1.7};
        ByHand own{lorentz(),
                   [&](const Vector& xi) {
                       Vector m(6);
                       for (int k = 0; k < 6; ++k) m(k) = I[k] * xi(k) + 0.4 * xi(k) * xi.squaredNorm();
                       return m;
                   },
                   [](const Matrix& g) {
                       Matrix S = Matrix::Zero(4, 4);
                       S(0, 0) = 0.5;
                       S(0, 3) = 2 * g(0, 3);
                       S(1, 2) = 0.3 * g(3, 3);
                       S(3, 3) = 0.3 * g(1, 2);
                       return S;
                   }};
        const System system =
            groupSystem(basisOf(own.basis),
                        "(xi1^2 + 1.5*xi2^2 + 2*xi3^2 + 1.2*xi4^2 + 0.8*xi5^2 + 1.7*xi6^2)/2 + 0.1*n^2 - "
                        "0.5*g11 - g14^2 - 0.3*g23*g44",
                        Value::Object{{"n", "xi1^2 + xi2^2 + xi3^2 + xi4^2 + xi5^2 + xi6^2"}});
        Vector xi(6);
        xi << 0.5, -0.3, 0.4, 0.2, 0.3, -0.4;
        checkOrders(system, startOf(system, xi), own.end(xi, 3), 16, 3, 8);
    }

    /// Sp(4), ten dimensions, in a basis that is neither orthogonal nor scaled.
    void symplecticGroup() {
        ByHand own{symplectic(),
                   [](const Vector& xi) {
                       Vector m = 2 * xi;
                       m(0) += 0.3 * xi(9);
                       m(9) += 0.3 * xi(0);
                       return m;
                   },
                   [](const Matrix& g) { return Matrix(0.5 * g); }};
        // U = |g|^2 / 4.
        std::string squares, kinetic;
        for (int i = 1; i <= 4; ++i)
            for (int j = 1; j <= 4; ++j)
                squares += (squares.empty() ? "g" : " + g") + std::to_string(10 * i + j) + "^2";
        for (int k = 1; k <= 10; ++k) kinetic += (k > 1 ? " + xi" : "xi") + std::to_string(k) + "^2";
        const std::string text = kinetic + " + 0.3*xi1*xi10 - (" + squares + ")/4";
        const System system = groupSystem(basisOf(own.basis), text.c_str());
        Vector xi(10);
        xi << 0.3, -0.2, 0.1, 0.2, 0.25, -0.1, 0.3, 0.1, -0.2, 0.2;
        checkOrders(system, startOf(system, xi), own.end(xi, 2), 16, 2, 5);
    }

    /// Affine maps of the plane: a body that stretches. In the entries of g it moves by x'' = -dU/dx, which
    /// knows no group at all.
    void affineGroup() {
        std::vector<Matrix> basis;
        for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 3; ++j) basis.push_back(unit(3, i, j));
        // x = upper two rows of g, U = sum x^2 / 2 + x_11^2 x_22 / 4 + x_13 x_21 / 2.
        const Rates rates = [](const List& y, List& dy, double) {
            for (std::size_t i = 0; i < 6; ++i) {
                dy[i] = y[6 + i];
                dy[6 + i] = -y[i];
            }
            dy[6] -= y[0] * y[4] / 2;
            dy[10] -= y[0] * y[0] / 4;
            dy[8] -= y[3] / 2;
            dy[9] -= y[2] / 2;
        };
        Vector xi(6);
        xi << 0.2, 0.4, 0.3, -0.3, 0.1, 0.5;
        List y{1, 0, 0, 0, 1, 0};
        y.insert(y.end(), xi.begin(), xi.end());
        const double duration = 1.2;
        const List end = integrated(rates, y, duration);
        List reference{end[0], end[1], end[2], end[3], end[4], end[5], 0, 0, 1};
        Matrix g = Matrix::Zero(3, 3), v = g;
        for (int i = 0; i < 6; ++i) {
            g(i / 3, i % 3) = end[static_cast<std::size_t>(i)];
            v(i / 3, i % 3) = end[static_cast<std::size_t>(6 + i)];
        }
        g(2, 2) = 1;
        for (const Matrix& E : basis) reference.push_back(v.cwiseProduct(g * E).sum());
        const System system = groupSystem(
            basisOf(basis),
            "(a11^2 + a12^2 + a13^2 + a21^2 + a22^2 + a23^2)/2 - (g11^2 + g12^2 + g13^2 + g21^2 + g22^2 + "
            "g23^2)/2 - g11^2*g22/4 - g13*g21/2",
            Value::Object{{"a11", "g11*xi1 + g12*xi4"},
                          {"a12", "g11*xi2 + g12*xi5"},
                          {"a13", "g11*xi3 + g12*xi6"},
                          {"a21", "g21*xi1 + g22*xi4"},
                          {"a22", "g21*xi2 + g22*xi5"},
                          {"a23", "g21*xi3 + g22*xi6"}});
        checkOrders(system, startOf(system, xi), reference, 9, duration, 6);
    }

    /// Three unlike factors that a potential couples: a body, an angle and a motion of the plane.
    void threeFactors() {
        ByHand own;
        const auto inBlock = [](const Matrix& E, int at) {
            Matrix m = Matrix::Zero(8, 8);
            m.block(at, at, E.rows(), E.cols()) = E;
            return m;
        };
        for (int k = 0; k < 3; ++k)
            own.basis.push_back(
                inBlock(unit(3, (k + 2) % 3, (k + 1) % 3) - unit(3, (k + 1) % 3, (k + 2) % 3), 0));
        own.basis.push_back(inBlock(unit(2, 1, 0) - unit(2, 0, 1), 3));
        own.basis.push_back(inBlock(unit(3, 1, 0) - unit(3, 0, 1), 5));
        own.basis.push_back(inBlock(unit(3, 0, 2), 5));
        own.basis.push_back(inBlock(unit(3, 1, 2), 5));
        const double I[] = {1, 1.5, 2.2, 0.7, 0.9, 1, 3};
        own.momenta = [&](const Vector& xi) {
            Vector m(7);
            for (int k = 0; k < 7; ++k) m(k) = I[k] * xi(k);
            m(2) += 0.2 * xi(3);
            m(3) += 0.2 * xi(2);
            return m;
        };
        // U = up_g33 w_g11 + up_g13 p_g13 + (p_g13^2 + p_g23^2) / 2 + w_g21 p_g11 / 2.
        own.slope = [](const Matrix& g) {
            Matrix S = Matrix::Zero(8, 8);
            S(2, 2) = g(3, 3);
            S(3, 3) = g(2, 2);
            S(0, 2) = g(5, 7);
            S(5, 7) = g(0, 2) + g(5, 7);
            S(6, 7) = g(6, 7);
            S(4, 3) = g(5, 5) / 2;
            S(5, 5) = g(4, 3) / 2;
            return S;
        };
        const System system = groupSystem(
            Value::Object{{"product", Value::Object{{"up", "so3"}, {"w", "u1"}, {"p", "se2"}}}},
            "(up_xi1^2 + 1.5*up_xi2^2 + 2.2*up_xi3^2)/2 + 0.35*w_xi1^2 + 0.2*up_xi3*w_xi1 + (0.9*p_xi1^2 + "
            "p_xi2^2 + 3*p_xi3^2)/2 - up_g33*w_g11 - up_g13*p_g13 - (p_g13^2 + p_g23^2)/2 - w_g21*p_g11/2");
        Vector xi(7);
        xi << 0.6, 0.3, -0.5, 0.8, 0.4, 0.5, -0.3;
        const List whole = own.end(xi, 4);
        List reference;
        const auto take = [&](int at, int n) {
            for (int i = 0; i < n; ++i)
                for (int j = 0; j < n; ++j)
                    reference.push_back(whole[static_cast<std::size_t>(8 * (at + i) + at + j)]);
        };
        take(0, 3);
        take(3, 2);
        take(5, 3);
        reference.insert(reference.end(), whole.end() - 7, whole.end());
        checkOrders(system, startOf(system, xi), reference, 22, 4, 10);
    }

    /// A charge on a sphere in a magnetic field along the vertical, b / 2 (x_1 x_2' - x_2 x_1'): a force that
    /// depends on the velocity and momenta that are not x x x'.
    void chargeOnASphere() {
        constexpr double b = 1.7;
        const auto three = [](const List& y, int at) {
            return Three(y[static_cast<std::size_t>(at)], y[static_cast<std::size_t>(at + 1)],
                         y[static_cast<std::size_t>(at + 2)]);
        };
        const Rates rates = [&](const List& y, List& dy, double) {
            const Three x = three(y, 0), v = three(y, 3);
            const Three F = b * v.cross(Three::UnitZ()) - Three::UnitZ() - 0.4 * x(0) * Three::UnitX();
            const Three a = F - (x.dot(F) + v.squaredNorm()) * x;
            for (int i = 0; i < 3; ++i) {
                dy[static_cast<std::size_t>(i)] = v(i);
                dy[static_cast<std::size_t>(3 + i)] = a(i);
            }
        };
        const List end = integrated(rates, {0.8, 0, -0.6, 0, 0.7, 0}, 8);
        const Three x = three(end, 0), v = three(end, 3);
        const Three pi = x.cross(v + b / 2 * Three(-x(1), x(0), 0));
        const System system = systemNamed(
            "spheres", {{"spheres", Value::Array{"x"}},
                        {"lagrangian",
                         "(x_1_t^2 + x_2_t^2 + x_3_t^2)/2 + b/2*(x_1*x_2_t - x_2*x_1_t) - x_3 - 0.2*x_1^2"},
                        {"parameters", Value::Object{{"b", b}}}});
        const State start{
            0, 0,
            system.start(
                Settings{"", {{"x", Value::Array{0.8, 0, -0.6}}, {"x_t", Value::Array{0, 0.7, 0}}}, {}}, 0)};
        checkOrders(system, start, {x(0), x(1), x(2), pi(0), pi(1), pi(2)}, 3, 8, 20);
    }

    /// Five spins on a graph that is no ring, with weights of both signs and fields that couple components.
    void spinsOnAGraph() {
        const int bonds[][2] = {{0, 1}, {1, 2}, {2, 0}, {2, 3}, {3, 4}, {0, 4}};
        const double weights[] = {1, -0.7, 2, 0.5, 1.3};
        List spins;
        for (int i = 0; i < 5; ++i) {
            const Three s = Three(std::sin(1.0 + i), std::cos(2.0 * i), 0.5 - 0.2 * i).normalized();
            spins.insert(spins.end(), s.data(), s.data() + 3);
        }
        const Rates rates = [&](const List& y, List& dy, double) {
            const auto at = [&](int i) { return Three(Eigen::Map<const Three>(y.data() + 3 * i)); };
            std::vector<Three> field(5);
            for (int i = 0; i < 5; ++i) {
                const Three s = at(i);
                field[static_cast<std::size_t>(i)] = Three(0.3 * s(1), 0.3 * s(0) + 0.4, 0.6 * s(2) * s(2));
            }
            // a1 b1 + 0.5 a2 b2 - a3 b3 + 0.2 (a1 b2 - a2 b1).
            for (const auto& bond : bonds) {
                const Three a = at(bond[0]), b = at(bond[1]);
                field[static_cast<std::size_t>(bond[0])] +=
                    Three(b(0) + 0.2 * b(1), 0.5 * b(1) - 0.2 * b(0), -b(2));
                field[static_cast<std::size_t>(bond[1])] +=
                    Three(a(0) - 0.2 * a(1), 0.5 * a(1) + 0.2 * a(0), -a(2));
            }
            for (int i = 0; i < 5; ++i)
                Eigen::Map<Three>(dy.data() + 3 * i) =
                    field[static_cast<std::size_t>(i)].cross(at(i)) / weights[i];
        };
        Value::Array pairs, list, start;
        for (const auto& bond : bonds) pairs.emplace_back(Value::Array{bond[0] + 1, bond[1] + 1});
        for (const double w : weights) list.emplace_back(w);
        for (std::size_t i = 0; i < spins.size(); i += 3)
            start.emplace_back(Value::Array{spins[i], spins[i + 1], spins[i + 2]});
        const System system =
            systemNamed("spins", {{"count", 5},
                                  {"bonds", pairs},
                                  {"parameters", Value::Object{}},
                                  {"pair", "a1*b1 + 0.5*a2*b2 - a3*b3 + 0.2*(a1*b2 - a2*b1)"},
                                  {"site", "0.3*s1*s2 + 0.4*s2 + 0.2*s3^3"},
                                  {"weights", list}});
        const State from{0, 0, system.start(Settings{"", {{"spins", start}}, {}}, 0)};
        const double duration = 4;
        const List reference = integrated(rates, spins, duration);
        for (int s = 1; s <= 3; ++s) {
            double before = 0, order = 0;
            for (int n = 20; n <= 80; n *= 2) {
                const auto end =
                    after(*makeIntegrator(system, *namedScheme("galerkin-gauss-" + std::to_string(s)),
                                          {0, duration / n}),
                          from, n);
                QVERIFY(end);
                double error = 0;
                List now(15);
                spins::spinsOf(*system.part<Spins>().model, end->x.data(), end->x.data() + 10, now.data());
                for (std::size_t i = 0; i < 15; ++i) error = std::max(error, std::abs(now[i] - reference[i]));
                if (before > 0 && error > 1e-12) order = std::log2(before / error);
                before = error;
            }
            qInfo("s = %d: %.2e, slope %.2f", s, before, order);
            QVERIFY(std::abs(order - 2 * s) < 0.2);
        }
    }
};

EXTREMAL_TEST(OtherGroupsTest)
}  // namespace extremal::other_groups_test

#include "other_groups_test.moc"
