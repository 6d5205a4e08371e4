// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed_potential.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <set>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text/expression.hpp"
#include "engine/core/text/invalid_text.hpp"
#include "engine/group/so3.hpp"
#include "engine/model/typed/landmarks.hpp"
#include "engine/model/typed/typed_mechanics.hpp"

namespace extremal {
namespace {

/// x, y, z, then R row by row.
constexpr int entries = 12;
using Gradient = Eigen::Matrix<double, entries, 1>;
using Hessian = Eigen::Matrix<double, entries, entries>;
using Rotation = so3::Matrix<double>;
using Vector = so3::Vector<double>;

struct TypedPotential {
    /// Of L = 1/2 |v|^2 - U in the twelve variables: the energy at rest is U, the force -dU.
    Mechanics<double> mechanics;
    int dimension = 6;  ///< of the group; on SO(3) the position is 0
};

struct Place {
    std::array<double, entries> q{};
    std::array<double, entries> v{};

    Place(const double* R, const double* x) {
        for (std::size_t i = 0; i < 3; ++i) {
            q[i] = x ? x[i] : 0;
            for (std::size_t j = 0; j < 3; ++j) q[3 + 3 * i + j] = R[3 * j + i];
        }
    }
};

Gradient pack(const Vector& x, const Rotation& R) {
    Gradient t;
    t.head<3>() = x;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) t(3 + 3 * i + j) = R(i, j);
    return t;
}

/// How (x, R) moves along g exp(eps zeta), zeta = (omega, v): (R v, R [omega]).
Gradient tangent(const Rotation& R, const Vector& omega, const Vector& v) {
    return pack(R * v, R * so3::hat(omega));
}

Vector angularPart(int a) { return a < 3 ? Vector(Vector::Unit(a)) : Vector(Vector::Zero()); }
Vector linearPart(int a) { return a < 3 ? Vector(Vector::Zero()) : Vector(Vector::Unit(a - 3)); }

void potential(const void* model, const double* R, const double* x, double* value, double* force,
               double* slope) {
    const auto& [m, dimension] = *static_cast<const TypedPotential*>(model);
    const Place place(R, x);
    if (value) *value = m.energy(m.model.get(), 0.0, place.q.data(), place.v.data());  // at rest
    if (!force && !slope) return;
    const Rotation rotation = Eigen::Map<const Rotation>(R);
    Gradient dL;
    m.force(m.model.get(), 0.0, place.q.data(), dL.data());
    Rotation dR;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) dR(i, j) = dL(3 + 3 * i + j);
    if (force) {
        // <dR, R [omega]> = <R^T dR, [omega]>.
        const Rotation M = rotation.transpose() * dR;
        const Vector linear = rotation.transpose() * dL.head<3>();
        const std::array<double, 6> f{M(2, 1) - M(1, 2), M(0, 2) - M(2, 0), M(1, 0) - M(0, 1),
                                      linear(0),         linear(1),         linear(2)};
        std::copy_n(f.begin(), dimension, force);
    }
    if (!slope) return;
    std::array<double, 2 * entries> gradient{};
    std::array<double, 4 * entries * entries> hessian;
    double L = 0;
    m.jet(m.model.get(), 0.0, place.q.data(), place.v.data(), &L, gradient.data(), hessian.data());
    Hessian H;
    for (int i = 0; i < entries; ++i)
        for (int j = 0; j < entries; ++j) H(i, j) = hessian[static_cast<std::size_t>(i * 2 * entries + j)];
    // f_a(g exp(eps e_b)) = f_a + eps (t_b . H t_a + dL . dt_a/db).
    for (int b = 0; b < dimension; ++b) {
        const Gradient Ht = H * tangent(rotation, angularPart(b), linearPart(b));
        const Rotation turned = rotation * so3::hat(angularPart(b));
        for (int a = 0; a < dimension; ++a)
            slope[dimension * b + a] =
                Ht.dot(tangent(rotation, angularPart(a), linearPart(a))) +
                dL.dot(pack(turned * linearPart(a), turned * so3::hat(angularPart(a))));
    }
}

bool isPosition(const std::string& name) { return name == "x" || name == "y" || name == "z"; }

void checkNames(const std::string& text, bool hasPosition,
                const std::vector<std::pair<std::string, double>>& parameters) {
    const Expression expression = parseExpression(text);
    std::set<std::string> known{"x", "y", "z", "pi"};
    for (const char* i : {"1", "2", "3"})
        for (const char* j : {"1", "2", "3"}) known.insert(std::string("R") + i + j);
    for (const auto& [name, value] : parameters) known.insert(name);
    for (const Expression::Node& node : expression.nodes) {
        std::string problem;
        if (node.kind == Operator::name && node.name == "t") problem = "a potential does not depend on t";
        if ((node.kind == Operator::name && node.name.ends_with("_t")) ||
            (node.kind == Operator::call && node.name == "dot"))
            problem = "a potential does not depend on velocities";
        if (!hasPosition && node.kind == Operator::name && isPosition(node.name))
            problem = "this body turns about a fixed point: " + node.name + " has no meaning";
        if (problem.empty() && node.kind == Operator::name && !known.contains(node.name))
            problem = "has an unknown name \"" + node.name + "\"";
        if (!problem.empty())
            throw ExpressionError(problem, node.position,
                                  std::string("names: ") +
                                      (hasPosition ? "x, y, z, R11..R33, mass" : "R11..R33") +
                                      ", I1, I2, I3 and the parameters");
    }
}

typed::TypedMechanics differentiated(const std::string& text, bool hasPosition,
                                     const std::vector<std::pair<std::string, double>>& parameters) {
    constexpr std::size_t prefix = 2;  // "-("
    typed::Formula formula;
    formula.coordinates = {"x", "y", "z", "R11", "R12", "R13", "R21", "R22", "R23", "R31", "R32", "R33"};
    formula.parameters = parameters;
    formula.text = "-(" + text + ")+(";
    for (const std::string& name : formula.coordinates)
        formula.text += (name == "x" ? "" : "+") + name + "_t^2";
    formula.text += ")/2";
    try {
        checkNames(text, hasPosition, parameters);
        return typed::makeMechanics(formula);
    } catch (const ExpressionError& e) {
        const bool isOfWhole = e.position >= prefix && e.position <= text.size() + prefix;
        const std::size_t place = isOfWhole ? e.position - prefix : std::min(e.position, text.size());
        throw invalidText("/potential", text, ExpressionError(e.what(), place, e.hint));
    }
}

/// Names beside the variables: mass, I1, I2, I3 and the user's own.
std::vector<std::pair<std::string, double>> parametersOf(const Settings& settings,
                                                         const BodyMechanics<double>& body) {
    std::vector<std::pair<std::string, double>> all{
        {"I1", body.inertia[0]}, {"I2", body.inertia[1]}, {"I3", body.inertia[2]}};
    if (body.dimension == 6) all.emplace_back("mass", body.inertia[3]);
    std::set<std::string> taken{"mass", "I1", "I2", "I3", "x", "y", "z"};
    for (const char* i : {"1", "2", "3"})
        for (const char* j : {"1", "2", "3"}) taken.insert(std::string("R") + i + j);
    const Value* own = settings.find("parameters");
    if (!own || !own->isObject()) return all;
    for (const auto& [name, value] : own->asObject()) {
        const std::string problem = nameProblem(name);
        if (!problem.empty())
            throw InvalidScene("/parameters/" + name, "the name \"" + name + "\" " + problem);
        if (!taken.insert(name).second)
            throw InvalidScene("/parameters/" + name, "the name \"" + name + "\" has a meaning already",
                               "another name");
        all.emplace_back(name, value.asNumber());
    }
    return all;
}

/// Places and attitudes at which a potential is looked at: random ones of several sizes, and some near the
/// landmarks of the formula, which are sought along a straight line or about an axis.
class PoseSampler {
public:
    explicit PoseSampler(const TypedPotential& potential)
        : movesInSpace_(potential.dimension == 6), landmarks_(*typed::landmarksOf(potential.mechanics)) {}

    static constexpr int random = 24, atEachLandmark = 24;
    int count() const { return random + atEachLandmark * static_cast<int>(landmarks_.size()); }
    std::pair<Vector, Rotation> next() {
        const int i = drawn_++;
        Vector x = vector() * (movesInSpace_ ? std::pow(10.0, i % 4 - 1) : 0);
        Rotation R = so3::Exponential<double, 0>(vector()).rotation();
        if (i < random) return {x, R};
        // One landmark, or all in turn, so that what lies at x = 50, y = 50 is met.
        const auto first = static_cast<std::size_t>((i - random) / atEachLandmark);
        for (std::size_t j = 0; j < (i % 2 == 0 ? 1 : landmarks_.size()); ++j)
            approach((first + j) % landmarks_.size(), x, R);
        return {x, R};
    }

private:
    Vector vector() { return Vector(normal_(random_), normal_(random_), normal_(random_)); }
    /// Goes along a coordinate that the landmark depends on, or turns about a random axis.
    void approach(std::size_t k, Vector& x, Rotation& R) {
        const std::vector<int>& symbols = landmarks_.symbols(k);
        const int symbol = symbols[random_() % symbols.size()];
        if (symbol >= entries) return;
        const Vector direction = symbol < 3 ? Vector(Vector::Unit(symbol)) : vector().normalized();
        const auto placeAt = [&](double s) { return symbol < 3 ? Vector(x + s * direction) : x; };
        const auto attitudeAt = [&](double s) {
            if (symbol < 3) return R;
            return Rotation(R * so3::Exponential<double, 0>(Vector(s * direction)).rotation());
        };
        const auto sum = [&](double s) {
            std::array<double, 2 * entries + 1> inputs{};  // at rest, t = 0
            const Vector place = placeAt(s);
            const Rotation attitude = attitudeAt(s);
            const Place pose(attitude.data(), place.data());
            std::copy(pose.q.begin(), pose.q.end(), inputs.begin());
            return landmarks_.value(k, inputs.data());
        };
        const double s = typed::nearZero(sum, 0, random_);
        x = placeAt(s);
        R = attitudeAt(s);
    }

    bool movesInSpace_;
    const typed::Landmarks& landmarks_;
    int drawn_ = 0;
    std::mt19937 random_{1};
    std::normal_distribution<double> normal_;
};

/// Whether U stays the same when everything is turned about space axis k.
bool isSymmetricAbout(int k, const TypedPotential& potential) {
    const Mechanics<double>& m = potential.mechanics;
    PoseSampler poses(potential);
    int probes = 0;
    for (int i = 0; i < poses.count(); ++i) {
        const auto [x, R] = poses.next();
        const Place place(R.data(), x.data());
        Gradient dL;
        m.force(m.model.get(), 0.0, place.q.data(), dL.data());
        const Vector axis = Vector::Unit(k);
        const Gradient turn = pack(so3::cross(axis, x), so3::hat(axis) * R);
        if (!dL.allFinite()) continue;
        ++probes;
        const double size = dL.cwiseAbs().dot(turn.cwiseAbs());
        if (std::abs(dL.dot(turn)) > 1e-11 * size) return false;
    }
    return probes > 0;
}

MomentumMap linearMomentum(std::size_t k) {
    constexpr std::array<const char*, 3> axes{"x", "y", "z"};
    return {std::string("linear.") + axes[k], std::string("p_") + axes[k], "kg m/s",
            [k](const double* x, const double*) { return x[13 + k]; }};
}
MomentumMap angularMomentum(std::size_t k, bool movesInSpace) {
    constexpr std::array<const char*, 3> axes{"x", "y", "z"};
    const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
    if (!movesInSpace)
        return {std::string("space.") + axes[k], std::string("π_") + axes[k], "kg m²/s",
                [k](const double* x, const double*) { return x[7 + k]; }};
    return {std::string("angular.") + axes[k], std::string("J_") + axes[k], "kg m²/s",
            [k, a, b](const double* x, const double*) {
                return x[7 + k] + x[10 + a] * x[13 + b] - x[10 + b] * x[13 + a];
            }};
}

}  // namespace

std::vector<FieldInfo> typedPotentialFields(bool movesInSpace) {
    FieldInfo potential =
        textField("potential", "U", "0",
                  std::string("U as an expression in ") + (movesInSpace ? "x, y, z, " : "") +
                      "R11..R33 (Rij: space component i of body axis j), " + (movesInSpace ? "mass, " : "") +
                      "I1, I2, I3 and the parameters.");
    potential.unit = "J";
    return {potential, constantsField("parameters", "Constants by name, for the potential.")};
}

std::vector<MomentumMap> setTypedPotential(BodyMechanics<double>& body, const Settings& settings) {
    const bool movesInSpace = body.dimension == 6;
    const typed::TypedMechanics made =
        differentiated(settings.text("potential"), movesInSpace, parametersOf(settings, body));
    auto model = std::make_shared<TypedPotential>();
    model->mechanics = made.mechanics;
    model->dimension = body.dimension;
    if (made.cyclic.size() < entries) {
        body.potential = potential;
        body.model = model;
    }
    std::vector<MomentumMap> momenta;
    for (const int i : made.cyclic)
        if (i < 3 && movesInSpace) momenta.push_back(linearMomentum(static_cast<std::size_t>(i)));
    for (int k = 0; k < 3; ++k)
        if (isSymmetricAbout(k, *model))
            momenta.push_back(angularMomentum(static_cast<std::size_t>(k), movesInSpace));
    return momenta;
}

}  // namespace extremal
