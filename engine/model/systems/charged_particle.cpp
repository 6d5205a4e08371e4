// SPDX-License-Identifier: GPL-3.0-or-later
/// A charged particle in given electric and magnetic potentials,
///     L = m/2 |v|^2 + charge (A(q, t) . v - phi(q, t)),    p = m v + charge A,
/// so that m a = charge (E + v x B) with B = curl A, E = -grad phi - dA/dt. SI units. The Lagrangian is
/// composed as a text and differentiated symbolically (engine/model/typed); p.v - L is the energy, and not
/// separable where A is there.
///
/// What else is known is found by sampling the derivatives: the canonical angular momentum x p_y - y p_x is
/// conserved where turning about z leaves L as it is, p_k where L has no k in it. In uniform fields the
/// motion is exact, in any gauge.
#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "engine/core/algebra/stumpff.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/expression.hpp"
#include "engine/core/text/invalid_text.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/system.hpp"
#include "engine/model/typed/landmarks.hpp"
#include "engine/model/typed/typed_mechanics.hpp"

namespace extremal::systems {
namespace {

using Vector = Eigen::Vector3d;
constexpr std::array<const char*, 3> axes = {"x", "y", "z"};

/// A potential as a text that stands in the Lagrangian. Errors go to `problems`, with pointers below /model.
std::string potentialText(const Value& value, const std::string& pointer, std::vector<Problem>& problems) {
    if (value.isNumber()) return "(" + formatNumber(value.asNumber()) + ")";
    if (!value.isString()) {
        problems.push_back({pointer, "must be an expression in x, y, z and t", "\"x^2/2\""});
        return "0";
    }
    static const std::vector<std::string> known = {"x", "y", "z", "t", "m", "charge"};
    const std::string text = value.asString();
    try {
        for (const Expression::Node& node : parseExpression(text).nodes) {
            if (node.kind == Operator::call && node.name == "dot")
                throw ExpressionError("has a velocity in it; potentials depend on x, y, z and t",
                                      node.position);
            if (node.kind == Operator::name && node.name != "pi" &&
                std::find(known.begin(), known.end(), node.name) == known.end())
                throw ExpressionError("has an unknown name \"" + node.name + "\"", node.position,
                                      "potentials depend on x, y, z and t; m and charge are known");
        }
    } catch (const ExpressionError& e) {
        problems.push_back(invalidText(pointer, text, e).problems().front());
    }
    return "(" + text + ")";
}

typed::Formula formulaOf(const Settings& settings) {
    std::vector<Problem> problems;
    const Value* A = settings.find("vector_potential");
    std::string text = "m/2*(x_t^2 + y_t^2 + z_t^2) - charge*" +
                       potentialText(*settings.find("scalar_potential"), "/scalar_potential", problems);
    if (A->isArray() && A->asArray().size() == 3) {
        for (std::size_t k = 0; k < 3; ++k)
            text += " + charge*" +
                    potentialText(A->asArray()[k], "/vector_potential/" + std::to_string(k), problems) + "*" +
                    axes[k] + "_t";
    } else {
        problems.push_back({"/vector_potential", "must be an array of three expressions in x, y, z and t",
                            "[\"-y/2\", \"x/2\", \"0\"] is a uniform field of 1 T along z"});
    }
    if (!problems.empty()) throw InvalidScene(std::move(problems));
    return {{"x", "y", "z"},
            {{"m", settings.number("m")}, {"charge", settings.number("charge")}},
            std::move(text)};
}

/// L's derivatives at one place.
struct Sample {
    Vector q, v;
    double L = 0;
    Eigen::Matrix<double, 6, 1> gradient;
    Eigen::Matrix<double, 6, 6, Eigen::RowMajor> hessian;

    bool isFinite() const { return std::isfinite(L) && gradient.allFinite() && hessian.allFinite(); }
    Vector force() const { return gradient.head<3>(); }
    Vector momentum() const { return gradient.tail<3>(); }
    /// charge B_i = charge eps_ijk dA_k/dq_j, from L_q_j,v_k = charge dA_k/dq_j.
    Vector curl() const {
        const auto d = [&](int j, int k) { return hessian(j, 3 + k); };
        return {d(1, 2) - d(2, 1), d(2, 0) - d(0, 2), d(0, 1) - d(1, 0)};
    }
};
Sample sampleAt(const Mechanics<double>& m, double t, const Vector& q, const Vector& v) {
    Sample s{q, v, 0, {}, {}};
    m.jet(m.model.get(), t, q.data(), v.data(), &s.L, s.gradient.data(), s.hessian.data());
    return s;
}
/// Places of several sizes and near the landmarks of the potentials, at rest or not; those where the
/// potentials have no value are left out.
std::vector<Sample> samples(const Mechanics<double>& m, bool isMoving) {
    std::vector<Sample> all;
    std::mt19937 random(1897);
    const auto uniform = [&] { return static_cast<double>(random()) / 2147483648.0 - 1; };
    for (int i = 0; i < 32; ++i) {
        const double size = std::pow(10.0, i % 4 - 1);
        Vector q, v;
        for (int k = 0; k < 3; ++k) {
            q[k] = size * uniform();
            v[k] = isMoving ? uniform() : 0;
        }
        const Sample s = sampleAt(m, i % 8 + 0.5 * uniform(), q, v);
        if (s.isFinite()) all.push_back(s);
    }
    const typed::Landmarks* const landmarks = typed::landmarksOf(m);
    for (std::size_t i = 0; i < 24 * landmarks->size(); ++i) {
        Eigen::Matrix<double, 7, 1> at;  // q, v, t
        for (double& number : at) number = uniform();
        if (!isMoving) at.segment<3>(3).setZero();
        // One landmark, or all in turn; only places and the time move.
        for (std::size_t j = 0; j < (i % 2 ? landmarks->size() : 1); ++j) {
            const std::size_t k = (i / 24 + j) % landmarks->size();
            const std::vector<int>& symbols = landmarks->symbols(k);
            const int symbol = symbols[random() % symbols.size()];
            if (symbol >= 3 && symbol < 6) continue;
            const auto sum = [&](double value) {
                auto moved = at;
                moved[symbol] = value;
                return landmarks->value(k, moved.data());
            };
            at[symbol] = typed::nearZero(sum, at[symbol], random);
        }
        const Sample s = sampleAt(m, at[6], at.head<3>(), at.segment<3>(3));
        if (s.isFinite()) all.push_back(s);
    }
    return all;
}

/// delta L = 0 under q -> q + e (e_z x q), v -> v + e (e_z x v).
bool isAxisymmetric(const Mechanics<double>& m) {
    const std::vector<Sample> all = samples(m, true);
    return all.size() >= 8 && std::all_of(all.begin(), all.end(), [](const Sample& s) {
               const double byQ = s.q[0] * s.force()[1] - s.q[1] * s.force()[0];
               const double byV = s.v[0] * s.momentum()[1] - s.v[1] * s.momentum()[0];
               const double size = s.q.norm() * s.force().norm() + s.v.norm() * s.momentum().norm();
               return std::abs(byQ + byV) <= 1e-12 * size;
           });
}

struct UniformFields {
    Vector force, curl;  ///< charge E, charge B
};
/// Fields that are the same at all places; A and phi may be anything that gives them.
std::optional<UniformFields> uniformFields(const Mechanics<double>& m) {
    if (m.isTimeDependent) return {};
    const std::vector<Sample> all = samples(m, false);
    if (all.size() < 32) return {};
    const UniformFields fields{all[0].force(), all[0].curl()};
    for (const Sample& s : all) {
        const double size = s.hessian.topRightCorner<3, 3>().norm() + fields.curl.norm();
        if ((s.curl() - fields.curl).norm() > 1e-12 * size) return {};
        if ((s.force() - fields.force).norm() > 1e-12 * (s.force().norm() + fields.force.norm())) return {};
    }
    return fields;
}

/// s, s^2/2 and s^3/6 for a frequency w = 0, and bounded multiples of 1/w, 1/w^2 and s/w^2 for others: the
/// integrals of cos(w s) from 0 to s, once to three times. Nothing is divided by a small w.
struct TurnIntegrals {
    double once, twice, thrice;

    TurnIntegrals(double w, double s) {
        const double z = w * s, half = sinc(z / 2);
        once = s * sinc(z);
        twice = s * s / 2 * half * half;
        // Beyond, the difference loses half a digit at most.
        thrice = z * z < 4 ? s * s * s * stumpff(3.0, z * z) : (s - once) / (w * w);
    }
    static double sinc(double x) { return x == 0 ? 1 : std::sin(x) / x; }
};

/// The motion m a = F + v x C in uniform fields: with f = F/m and the frequency W = C/m, |W| = w, and I_1,
/// I_2, I_3 the integrals of cos(w s),
///     along W:    q = q_0 + v_0 s + f s^2/2,                        v = v_0 + f s
///     across W:   q = q_0 + v_0 I_1 + (v_0 x W + f) I_2 + (f x W) I_3,
///                 v = v_0 cos(w s) + (v_0 x W + f) I_1 + (f x W) I_2
/// In a strong field I_3 is the drift F x C / C^2, in a weak one the fall; neither is a limit of the formula.
ExactSolution exactMotion(const Mechanics<double>& m, const UniformFields& fields, double mass,
                          const State& initial) {
    const double t0 = initial.t;
    const Vector q0(initial.x.data()), W = fields.curl / mass, f = fields.force / mass;
    Vector v0;
    if (!m.velocity(m.model.get(), t0, q0.data(), initial.x.data() + 3, v0.data())) return {};
    const double w = W.stableNorm();
    const Vector b = w > 0 ? Vector(W / w) : Vector(Vector::Zero());
    const auto alongField = [&](const Vector& a) { return w > 0 ? Vector(b * b.dot(a)) : a; };
    const Vector vAlong = alongField(v0), vAcross = v0 - vAlong;
    const Vector fAlong = alongField(f), fAcross = f - fAlong;
    const Vector turned = vAcross.cross(W) + fAcross, drift = fAcross.cross(W);
    return [=](double t, std::span<double> x) {
        const double s = t - t0;
        const TurnIntegrals I(w, s);
        const Vector v = vAlong + fAlong * s + vAcross * std::cos(w * s) + turned * I.once + drift * I.twice;
        const Vector q =
            q0 + vAlong * s + fAlong * (0.5 * s * s) + vAcross * I.once + turned * I.twice + drift * I.thrice;
        std::array<double, 6> gradient;
        m.gradient(m.model.get(), t, q.data(), v.data(), gradient.data());
        std::copy_n(q.data(), 3, x.begin());
        std::copy_n(gradient.begin() + 3, 3, x.begin() + 3);
    };
}

System makeChargedParticle(const Settings& settings) {
    const typed::Formula formula = formulaOf(settings);
    typed::TypedMechanics made;
    try {
        made = typed::makeMechanics(formula);
    } catch (const ExpressionError& e) {
        throw invalidText("", formula.text, e, "the Lagrangian of these potentials ");
    }
    System s;
    s.id = "charged-particle";
    for (const char* axis : axes)
        s.coordinates.push_back({axis, std::string("position ") + axis, axis, "m", "kg m/s"});
    s.timeUnit = "s";
    s.energyUnit = "J";
    s.parts.set(made.mechanics);
    if (isAxisymmetric(s.mechanics()))
        s.momenta.push_back({"z", "L_z", "kg m²/s",
                             [](const double* q, const double* p) { return q[0] * p[1] - q[1] * p[0]; }});
    for (const int i : made.cyclic) {
        const auto k = static_cast<std::size_t>(i);
        s.momenta.push_back({std::string("linear.") + axes[k], std::string("p_") + axes[k], "kg m/s",
                             [k](const double*, const double* p) { return p[k]; }});
    }
    if (const auto fields = uniformFields(s.mechanics()))
        s.exact = [m = s.mechanics(), fields = *fields, mass = settings.number("m")](const State& initial) {
            return exactMotion(m, fields, mass, initial);
        };
    s.draw = [](const double* x, Drawing& drawing) {
        drawing.shapes.push_back(Disc{{0, 0, 0}, 2, ShapeRole::scenery});
        drawing.shapes.push_back(Disc{{x[0], x[1], x[2]}, 7});
        drawing.tracer = {x[0], x[1], x[2]};
    };
    s.phaseX = "q.x";
    s.phaseY = "p.x";
    s.trajectoryX = "q.x";
    s.trajectoryY = "q.y";
    s.hasPlanarTrajectory = true;
    return s;
}

void checkPotentials(const Settings& settings, const System& system, const State& initial) {
    const auto fault = typed::faultAt(formulaOf(settings), system.mechanics(), initial.t, initial.x.data(),
                                      initial.x.data() + system.dimension());
    if (fault) throw InvalidScene("", "the Lagrangian of these potentials " + *fault);
}

std::vector<FieldInfo> chargedParticleFields() {
    FieldInfo charge = positive("charge", "charge", "C", 1, "Charge of the particle, of either sign.");
    charge.min = -std::numeric_limits<double>::infinity();
    charge.isMinExcluded = false;
    FieldInfo A, phi;
    A.key = "vector_potential";
    A.title = "vector potential";
    A.symbol = "A";
    A.unit = "T m";
    A.type = phi.type = FieldType::json;
    A.fallback = Value(Value::Array{"-y/2", "x/2", "0"});
    A.description = "Three expressions in x, y, z and t; the magnetic field is the curl.";
    phi.key = "scalar_potential";
    phi.title = "scalar potential";
    phi.symbol = "φ";
    phi.unit = "V";
    phi.fallback = "0";
    phi.description = "An expression in x, y, z and t; the electric field is -grad φ - dA/dt.";
    return {positive("m", "mass", "kg", 1, "Mass of the particle."), charge, A, phi};
}

}  // namespace

ModelEntry charged_particle() {
    ModelEntry e;
    e.item = {"charged-particle",
              "charged particle",
              "A particle in electric and magnetic fields, given by their potentials.",
              chargedParticleFields(),
              {},
              ""};
    e.exampleQ = {1, 0, 0};
    e.exampleP = {0, -0.5, 0.1};  // v = (0, -1, 0.1): a helix of radius 1 about the z axis
    e.exampleEnd = 20;
    e.exampleStep = 0.1;
    e.make = makeChargedParticle;
    e.lagrangian = [](const Settings& settings) -> std::string { return formulaOf(settings).text; };
    e.checkInitial = checkPotentials;
    return e;
}

}  // namespace extremal::systems
