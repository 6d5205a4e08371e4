// SPDX-License-Identifier: GPL-3.0-or-later
/// The names in the expressions of events: t, every column of the state with its dots as underscores
/// (q_theta, p_theta, attitude_w), and coordinates by their own names (theta) where no parameter of the model
/// has that name. Of systems with a Lagrangian also velocities (theta_t), `energy`, and the reactions of
/// constraints and rolling conditions (reaction_rod, the multiplier). integral(e) is the integral of an
/// expression over time since the start.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/core/text/expression.hpp"
#include "engine/model/system.hpp"
#include "engine/scene/scene.hpp"

namespace extremal {

class Mechanism;

struct StateName {
    enum class Kind { time, column, velocity, energy, reaction, integral };
    std::string name;
    Kind kind = Kind::time;
    int index = 0;  ///< of the column, the coordinate, the condition or the integral
};
std::vector<StateName> stateNames(const System& system, const std::vector<std::string>& parameters);

/// An expression with names in place of its integrals, which have no integrals in them: 2*integral(x)-1 is
/// 2*integral_1-1 with blanks, so that every other character keeps its place. Throws ExpressionError where an
/// integral is within another one, or there are more than nine.
struct EventText {
    std::string outer;
    std::vector<std::string> integrands;
    static EventText of(const std::string& text);
    std::vector<std::string> integralNames() const;
};

/// The value of an event's expression at (t, x); the expression has been checked. A comparison, or several
/// with
/// && and ||, is 1 or 0 and has no zero that is passed: it is what is positive where it is true, the
/// difference of its sides, so that it is an event upwards where it becomes true.
///
/// Not to be called by two threads at once.
class EventFunction {
public:
    EventFunction(const EventSpec& event, const System& system);
    EventFunction(const EventFunction&);
    EventFunction(EventFunction&&) noexcept;
    EventFunction& operator=(const EventFunction& other) { return *this = EventFunction(other); }
    EventFunction& operator=(EventFunction&&) noexcept;
    ~EventFunction();

    /// `integrals`: the values of those in it.
    double operator()(double t, const double* x, std::span<const double> integrals = {}) const;
    /// What is under its integrals.
    const std::vector<EventFunction>& integrands() const { return integrands_; }
    /// The values of its parts, as the last call found them.
    std::span<const double> parts() const { return values_; }

private:
    struct Place {
        enum class Kind { operation, number, name } what = Kind::operation;
        StateName::Kind kind = StateName::Kind::time;
        int index = 0;
        double value = 0;
    };
    EventFunction(const std::string& text, const EventSpec& event, const System& system);
    void measureTruth(int node);
    void findMotion(double t, const double* x) const;
    double valueOf(const Place& place, double t, const double* x, std::span<const double> integrals) const;

    Expression expression_;
    std::vector<Place> places_;  ///< of each node
    std::vector<EventFunction> integrands_;
    mutable std::vector<double> values_;    ///< of each node
    EnergyFunction energy_;                 ///< where it is in it
    std::unique_ptr<Mechanism> mechanism_;  ///< where velocities or reactions are in it
    bool hasReactions_ = false;
    mutable std::vector<double> velocity_, reactions_;
};

}  // namespace extremal
