// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/body/rigid.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/group/so3.hpp"
#include "engine/model/body/body_hand.hpp"
#include "engine/model/casimir_measure.hpp"

namespace extremal {
namespace {

using Vector = so3::Vector<double>;
using Matrix = so3::Matrix<double>;
using Quaternion = so3::Quaternion<double>;
using Map = Eigen::Map<const Vector>;

Quaternion attitude(const double* x) { return {x[0], x[1], x[2], x[3]}; }

Vector omega(const BodyMechanics<double>& body, const double* x) {
    return {x[4] / body.inertia[0], x[5] / body.inertia[1], x[6] / body.inertia[2]};
}

std::vector<Quantity> columnsOf(const BodyMechanics<double>& body) {
    const char* spin = "kg m²/s";
    std::vector<Quantity> columns;
    for (const char* c : {"w", "x", "y", "z"})
        columns.push_back(
            {std::string("attitude.") + c, std::string("attitude ") + c, std::string("q_") + c, ""});
    for (const auto& [c, symbol] : {std::pair{"1", "Π₁"}, {"2", "Π₂"}, {"3", "Π₃"}})
        columns.push_back(
            {std::string("momentum.body.") + c, std::string("body momentum ") + c, symbol, spin});
    for (const char* c : {"x", "y", "z"})
        columns.push_back({std::string("momentum.space.") + c, std::string("space momentum ") + c,
                           std::string("π_") + c, spin});
    if (body.dimension != 6) return columns;
    for (const char* c : {"x", "y", "z"})
        columns.push_back({std::string("position.") + c, std::string("position ") + c, c, "m"});
    for (const char* c : {"x", "y", "z"})
        columns.push_back(
            {std::string("p.") + c, std::string("linear momentum ") + c, std::string("p_") + c, "kg m/s"});
    return columns;
}

ErrorMeasure errorOf(const BodyMechanics<double>& body) {
    ErrorMeasure m;
    m.isOfPhase = true;
    m.columns = {{"error", "", "∠(R, R_ref)", "rad"}, {"error.p", "", "|Π - Π_ref|", "kg m²/s"}};
    const bool movesInSpace = body.dimension == 6;
    if (movesInSpace) m.columns.push_back({"error.position", "", "|x - x_ref|", "m"});
    m.evaluate = [movesInSpace](const double* x, const double* reference, double* values) {
        const Quaternion d = so3::product(so3::conjugate(attitude(reference)), attitude(x));
        values[0] = 2 * std::atan2(std::hypot(d(1), d(2), d(3)), std::abs(d(0)));
        values[1] = (Map(x + 4) - Map(reference + 4)).norm();
        if (movesInSpace) values[2] = (Map(x + 10) - Map(reference + 10)).norm();
    };
    return m;
}

/// xdot: q' = q (0, omega) / 2, Pi' = Pi x omega + torque, pi' = R torque, x' = p / m, p' = force.
void rate(const BodyMechanics<double>& body, const double* x, double* dx) {
    const Vector w = omega(body, x), momentum = Map(x + 4);
    const Quaternion q = attitude(x), dq = so3::product(q, Quaternion(0, w(0), w(1), w(2))) / 2;
    const Matrix R = so3::matrix(q);
    std::array<double, 6> f{};
    if (!body.isFree())
        body.potential(body.model.get(), R.data(), body.dimension == 6 ? x + 10 : nullptr, nullptr, f.data(),
                       nullptr);
    const Vector torque = Map(f.data()), dPi = so3::cross(momentum, w) + torque, dpi = R * torque;
    for (int i = 0; i < 4; ++i) dx[i] = dq(i);
    for (int i = 0; i < 3; ++i) {
        dx[4 + i] = dPi(i);
        dx[7 + i] = dpi(i);
    }
    if (body.dimension != 6) return;
    const Vector force = R * Map(f.data() + 3);
    for (int i = 0; i < 3; ++i) {
        dx[10 + i] = x[13 + i] / body.inertia[3];
        dx[13 + i] = force(i);
    }
}

/// How fast the body turns, or swings in its potential: the larger.
double frequency(const BodyMechanics<double>& body, const double* x) {
    const double turning = omega(body, x).norm();
    if (body.isFree()) return turning;
    const Matrix R = so3::matrix(attitude(x));
    std::array<double, 36> slope{};
    body.potential(body.model.get(), R.data(), body.dimension == 6 ? x + 10 : nullptr, nullptr, nullptr,
                   slope.data());
    double stiffest = 0;
    for (int row = 0; row < body.dimension; ++row)
        for (int column = 0; column < body.dimension; ++column)
            stiffest =
                std::max(stiffest, std::abs(slope[static_cast<std::size_t>(column * body.dimension + row)]) /
                                       body.inertia[static_cast<std::size_t>(row)]);
    const double swinging = std::sqrt(stiffest);
    return std::isfinite(swinging) ? std::max(turning, swinging) : turning;
}

std::vector<double> startOf(const BodyMechanics<double>& body, const Settings& initial) {
    const std::vector<double> given = initial.numbers("attitude");
    Quaternion q(given[0], given[1], given[2], given[3]);
    const double length = q.norm();
    if (!(std::abs(length - 1) <= 1e-6))
        throw InvalidScene("/attitude", "must have length 1 (to 1e-6), got " + formatNumber(length, 8),
                           "divide the four numbers by their length");
    q /= length;
    const std::vector<double> momentum = initial.numbers("momentum"), rates = initial.numbers("omega");
    if (momentum.empty() == rates.empty())
        throw InvalidScene(
            momentum.empty() ? "" : "/omega",
            momentum.empty() ? "has neither momentum nor omega" : "stands beside momentum: one is too many",
            "give exactly one of momentum and omega, in body axes");
    Vector Pi;
    for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        Pi(i) = rates.empty() ? momentum[k] : body.inertia[k] * rates[k];
    }
    const Vector pi = so3::matrix(q) * Pi;
    std::vector<double> x{q(0), q(1), q(2), q(3), Pi(0), Pi(1), Pi(2), pi(0), pi(1), pi(2)};
    if (body.dimension != 6) return x;
    const std::vector<double> position = initial.numbers("position"), velocity = initial.numbers("velocity");
    std::vector<double> linear = initial.numbers("linear_momentum");
    if (!linear.empty() && !velocity.empty())
        throw InvalidScene("/velocity", "stands beside linear_momentum: one is too many",
                           "give at most one of velocity and linear_momentum");
    if (linear.empty()) linear.assign(3, 0);
    x.insert(x.end(), position.begin(), position.end());
    for (std::size_t i = 0; i < 3; ++i)
        x.push_back(velocity.empty() ? linear[i] : body.inertia[3] * velocity[i]);
    return x;
}

FieldInfo optionalVector(const char* key, const char* title, const char* symbol, const char* unit,
                         std::vector<std::string> components, const char* description) {
    FieldInfo f = numbers(key, title, unit, std::move(components), nullptr, description);
    f.symbol = symbol;
    f.isOptional = true;
    return f;
}

}  // namespace

double bodyPotential(const BodyMechanics<double>& body, const double* x) {
    if (body.isFree()) return 0;
    const Matrix R = so3::matrix(attitude(x));
    double value = 0;
    body.potential(body.model.get(), R.data(), body.dimension == 6 ? x + 10 : nullptr, &value, nullptr,
                   nullptr);
    return value;
}

void addCasimir(System& system, EnergyFunction casimir) {
    system.measures.push_back(
        casimirMeasure({{"casimir", "", "C", ""}},
                       [casimir](double t, const double* x, double* values) { values[0] = casimir(t, x); }));
}

void describeBody(System& system, const Body& body) {
    system.parts.set(body);
    system.measures.push_back(
        {"orthogonality", {{"orthogonality", "", "|RᵀR - 1|", ""}}, -1, [](const State&) {
             return [](double, const double* q, double* values) {
                 const double square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
                 values[0] = std::sqrt(3.0) * std::abs(square - 1) * (square + 1);
             };
         }});
    system.timeUnit = "s";
    system.energyUnit = "J";
    system.columns = columnsOf(body);
    system.error = errorOf(body);
    system.energy = [body](double, const double* x) {
        double sum = 0;
        for (std::size_t i = 0; i < 3; ++i) sum += x[4 + i] * x[4 + i] / (2 * body.inertia[i]);
        for (std::size_t i = 3; i < static_cast<std::size_t>(body.dimension); ++i)
            sum += x[10 + i] * x[10 + i] / (2 * body.inertia[i]);
        return sum + bodyPotential(body, x);
    };
    system.kineticEnergy = [body](double, const double* x) {
        double sum = 0;
        for (std::size_t k = 0; k < 3; ++k) sum += x[4 + k] * x[4 + k] / body.inertia[k];
        if (body.dimension == 6)
            for (std::size_t k = 0; k < 3; ++k) sum += x[13 + k] * x[13 + k] / body.inertia[3 + k];
        return sum / 2;
    };
    constexpr std::size_t attitude = 4;
    system.blocks = {attitude, {static_cast<std::size_t>(body.stateSize()) - attitude}};
    system.rate = [body](double, const double* x, double* dx) {
        rate(body, x, dx);
        return true;
    };
    system.frequency = [body](double, const double* x) { return frequency(body, x); };
    system.start = [body](const Settings& initial, double) { return startOf(body, initial); };
    system.parts.set(bodyByHand(body));
    system.isSpatial = true;
    system.phaseX = "momentum.body.1";
    system.phaseY = "momentum.body.2";
    system.trajectoryX = "t";
    system.trajectoryY = "momentum.body.1";
    system.timePlots = {"momentum.body.1", "momentum.body.2", "momentum.body.3"};
}

std::vector<FieldInfo> bodyInitialFields(bool movesInSpace) {
    const std::vector<std::string> body{"1", "2", "3"}, space{"x", "y", "z"};
    std::vector<FieldInfo> fields{
        numbers("attitude", "attitude", "", {"w", "x", "y", "z"}, Value::Array{1.0, 0.0, 0.0, 0.0},
                "Quaternion from body to space, of length 1."),
        optionalVector("momentum", "momentum", "Π", "kg m²/s", body, "Angular momentum in body axes."),
        optionalVector("omega", "rate", "Ω", "rad/s", body,
                       "Angular velocity in body axes, instead of momentum.")};
    if (!movesInSpace) return fields;
    fields.push_back(numbers("position", "position", "m", space, Value::Array{0.0, 0.0, 0.0},
                             "Centre of mass in space axes."));
    fields.push_back(optionalVector("velocity", "velocity", "v", "m/s", space,
                                    "Velocity of the centre of mass, in space axes."));
    fields.push_back(optionalVector("linear_momentum", "impulse", "p", "kg m/s", space,
                                    "Linear momentum in space axes, instead of velocity."));
    return fields;
}

FieldInfo inertiaField(std::array<double, 3> fallback) {
    FieldInfo f = numbers("inertia", "inertia", "kg m²", {"1", "2", "3"},
                          Value::Array{fallback[0], fallback[1], fallback[2]},
                          "The three principal moments of inertia.");
    f.symbol = "I";
    f.min = 0;
    f.isMinExcluded = true;
    return f;
}

void drawSpaceAxes(double length, Drawing& drawing) {
    const char* names[] = {"x", "y", "z"};
    for (std::size_t i = 0; i < 3; ++i) {
        std::array<double, 3> tip{}, word{};
        tip[i] = length;
        word[i] = 1.06 * length;
        drawing.shapes.push_back(Segment{{0, 0, 0}, onStage(tip[0], tip[1], tip[2]), 1, ShapeRole::scenery});
        drawing.shapes.push_back(Word{onStage(word[0], word[1], word[2]), names[i]});
    }
}

}  // namespace extremal
