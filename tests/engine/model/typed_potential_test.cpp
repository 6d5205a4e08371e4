// SPDX-License-Identifier: GPL-3.0-or-later
/// Potentials of bodies as formulas: force and slope against differences of U along the group and against the
/// known torque of a gravity gradient, the momenta they leave, and what is refused.
#include <QTest>

#include <cmath>

#include "engine/core/problem.hpp"
#include "engine/group/se3.hpp"
#include "engine/model/system.hpp"
#include "engine/model/typed_potential.hpp"
#include "tests/tools/jacobian.hpp"
#include "tests/tools/test.hpp"

namespace extremal::typed_potential_test {
namespace {

using Vector = so3::Vector<double>;
using Twist = se3::Vector<double>;

BodyMechanics<double> bodyWith(const std::string& potential, int dimension = 6,
                               std::vector<MomentumMap>* momenta = nullptr, Value::Object parameters = {}) {
    BodyMechanics<double> body;
    body.dimension = dimension;
    body.inertia = {0.7, 1.1, 1.6, 2, 2, 2};
    const auto kept =
        setTypedPotential(body, {"", {{"potential", potential}, {"parameters", Value(parameters)}}, {}});
    if (momenta) *momenta = kept;
    return body;
}

struct Evaluated {
    double U = 0;
    Eigen::VectorXd force;
    Eigen::MatrixXd slope;
};
Evaluated at(const BodyMechanics<double>& body, const se3::Motion<double>& g) {
    Evaluated e;
    e.force.resize(body.dimension);
    e.slope.resize(body.dimension, body.dimension);
    body.potential(body.model.get(), g.rotation.data(), body.dimension == 6 ? g.position.data() : nullptr,
                   &e.U, e.force.data(), e.slope.data());
    return e;
}
se3::Motion<double> moved(const se3::Motion<double>& g, const Eigen::VectorXd& zeta, double by) {
    Twist twist = Twist::Zero();
    twist.head(zeta.size()) = by * zeta;
    return se3::product(g, se3::Exponential<double, 0>(twist).motion());
}
se3::Motion<double> somewhere() {
    return se3::Exponential<double, 0>((Twist() << 0.4, -0.9, 1.3, 0.8, 1.1, -0.5).finished()).motion();
}

const char* const gravityGradient =
    "-mu*mass/sqrt(x^2+y^2+z^2) - mu/(2*(x^2+y^2+z^2)^(3/2))*(I1+I2+I3 - 3*(I1*(x*R11+y*R21+z*R31)^2"
    " + I2*(x*R12+y*R22+z*R32)^2 + I3*(x*R13+y*R23+z*R33)^2)/(x^2+y^2+z^2))";

std::vector<std::string> namesOf(const std::vector<MomentumMap>& momenta) {
    std::vector<std::string> names;
    for (const MomentumMap& m : momenta) names.push_back(m.name);
    return names;
}

}  // namespace

class TypedPotentialTest : public QObject {
    Q_OBJECT
private slots:
    void forceAndSlopeAreTheDerivativesAlongTheGroup() {
        for (const int dimension : {3, 6}) {
            const BodyMechanics<double> body = dimension == 6
                                                   ? bodyWith("sin(x*R12 + y) + z^2*R33 + exp(R21*R13)*x", 6)
                                                   : bodyWith("sin(R12 + R23) + R33^2 + exp(R21*R13)", 3);
            const auto g = somewhere();
            const Evaluated here = at(body, g);
            constexpr double d = 1e-3;
            constexpr std::array<double, 3> c = centralDifferences;
            double force = 0, slope = 0, transposed = 0;
            for (int b = 0; b < dimension; ++b) {
                const Eigen::VectorXd zeta = Eigen::VectorXd::Unit(dimension, b);
                double dU = 0;
                Eigen::VectorXd df = Eigen::VectorXd::Zero(dimension);
                for (int k = 1; k <= 3; ++k)
                    for (const int side : {1, -1}) {
                        const Evaluated there = at(body, moved(g, zeta, side * k * d));
                        dU += side * c[static_cast<std::size_t>(k - 1)] / d * there.U;
                        df += side * c[static_cast<std::size_t>(k - 1)] / d * there.force;
                    }
                force = std::max(force, std::abs(dU + here.force(b)));
                slope = std::max(slope, (df - here.slope.col(b)).norm());
                transposed = std::max(transposed, (df - here.slope.row(b).transpose()).norm());
            }
            qInfo("dimension %d: force %.1e, slope %.1e; its transpose %.1e", dimension, force, slope,
                  transposed);
            QVERIFY(force < 1e-11);
            QVERIFY(slope < 1e-11);
            QVERIFY(transposed > 1e-3);  // the order of rows and columns matters: the law can fail
        }
    }
    void theGravityGradientTurnsTheBodyAsItIsKnownTo() {
        // Torque in the body 3 mu / r^5 (rho x I rho), rho = R^T x; force -mu m x / r^3 + ... to the order of
        // the body's size.
        const BodyMechanics<double> body = bodyWith(gravityGradient, 6, nullptr, {{"mu", 1.7}});
        const auto g = somewhere();
        const Vector rho = g.rotation.transpose() * g.position, I(0.7, 1.1, 1.6);
        const double r = g.position.norm();
        const Vector torque = 3 * 1.7 / std::pow(r, 5) * so3::cross(rho, Vector(I.cwiseProduct(rho)));
        const Vector force = -1.7 * 2 / std::pow(r, 3) * rho -
                             1.5 * 1.7 / std::pow(r, 5) * (2 * I.cwiseProduct(rho) + I.sum() * rho) +
                             7.5 * 1.7 / std::pow(r, 7) * rho.dot(I.cwiseProduct(rho)) * rho;
        const Evaluated here = at(body, g);
        QVERIFY((here.force.head(3) - torque).norm() < 1e-14);
        qInfo("force %.1e", (here.force.tail(3) - force).norm() / force.norm());
        QVERIFY((here.force.tail(3) - force).norm() < 1e-13 * force.norm());
    }
    void theMomentaAreThoseOfTheSymmetriesLeft() {
        const auto names = [](const std::string& U, int dimension = 6) {
            std::vector<MomentumMap> momenta;
            (void)bodyWith(U, dimension, &momenta, {{"mu", 1.0}});
            return namesOf(momenta);
        };
        using Names = std::vector<std::string>;
        QCOMPARE(names(gravityGradient), (Names{"angular.x", "angular.y", "angular.z"}));
        QCOMPARE(names("9.81*mass*z"), (Names{"linear.x", "linear.y", "angular.z"}));
        QCOMPARE(names("x*y"), (Names{"linear.z"}));
        QCOMPARE(names("R11*x + R21*y"), (Names{"linear.z", "angular.z"}));
        QCOMPARE(names("R33 + R31^2", 3), (Names{"space.z"}));
        QCOMPARE(names("R33 + R21", 3), (Names{}));
        QCOMPARE(names("0").size(), std::size_t(6));
        // What is nearly constant where one usually looks.
        QCOMPARE(names("exp(-(x-500)^2 - (y-20)^2)"), (Names{"linear.z"}));
        QCOMPARE(names("exp(-1e6*(R33-0.5)^2)", 3), (Names{"space.z"}));
        QVERIFY(bodyWith("2*mass").isFree());
    }
    void whatHasNoMeaningIsRefusedWithItsPlace_data() {
        QTest::addColumn<QString>("potential");
        QTest::addColumn<int>("dimension");
        QTest::addColumn<QString>("says");
        QTest::addRow("time") << "x*t" << 6 << "does not depend on t";
        QTest::addRow("velocity") << "x_t^2" << 6 << "does not depend on velocities";
        QTest::addRow("unknown") << "x + omega" << 6 << "omega";
        QTest::addRow("syntax") << "x + * y" << 6 << "^";
        QTest::addRow("place on SO(3)") << "R33*x" << 3 << "fixed point";
        QTest::addRow("mass on SO(3)") << "R33*mass" << 3 << "mass";
    }
    void whatHasNoMeaningIsRefusedWithItsPlace() {
        QFETCH(QString, potential);
        QFETCH(int, dimension);
        QFETCH(QString, says);
        try {
            (void)bodyWith(potential.toStdString(), dimension);
            QFAIL("accepted");
        } catch (const InvalidScene& e) {
            qInfo("%s", e.what());
            QCOMPARE(QString::fromStdString(e.problems()[0].pointer), QString("/potential"));
            QVERIFY(QString(e.what()).contains(says));
        }
    }
};

EXTREMAL_TEST(TypedPotentialTest)
}  // namespace extremal::typed_potential_test

#include "typed_potential_test.moc"
