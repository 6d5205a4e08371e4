// SPDX-License-Identifier: GPL-3.0-or-later
/// A scene: everything that defines a comparison, as a value. Equal scenes give equal bytes.
///
/// A scene is read by scene/write/codec.hpp, which checks it against the catalogues; a Scene in hand is
/// valid. Editing makes a new scene; undo is the previous one.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/algebra/number.hpp"
#include "engine/core/impact.hpp"
#include "engine/core/settings.hpp"
#include "engine/core/value.hpp"
#include "engine/phase/invariants.hpp"
#include "engine/view/view.hpp"

namespace extremal {

/// A row of the comparison: a discretization space x quadrature, a baseline, or a named scheme.
struct SchemeSpec {
    enum class Kind { discretization, baseline, named };
    Kind kind = Kind::discretization;
    std::string label;
    bool isEnabled = true;
    std::optional<int> style;  ///< number of its colour and dash, from 0; empty: its place in the scene
    Number step;               ///< 0 for adaptive baselines
    std::optional<double> tolerance;       ///< adaptive baselines
    Settings space, quadrature;            ///< discretization
    Settings baseline;                     ///< baseline: type = its name, keys = its options
    std::string named;                     ///< named: id from the scheme catalogue
    Settings composition;                  ///< type = "yoshida", ...; empty: the scheme as it is
    std::vector<KeptQuantity> keep;        ///< what its steps keep; empty: the symplectic form
    ImpactLaw impact = ImpactLaw::energy;  ///< what is equal on both sides of an impact without a loss
    Settings monitor;                      ///< what its steps follow: type = "auto", ...; empty: equal steps
    Settings solver;  ///< type = method ("auto", "newton", "fixed-point"); keys tolerance, max_iterations
    bool allowsUnstable = false;

    // Compiled once.
    SchemeSpec();
    SchemeSpec(const SchemeSpec&);
    SchemeSpec(SchemeSpec&&) noexcept;
    SchemeSpec& operator=(const SchemeSpec&);
    SchemeSpec& operator=(SchemeSpec&&) noexcept;
    ~SchemeSpec();
    bool operator==(const SchemeSpec&) const;
};

/// Colour and dash of a scheme at this place, disabled ones counted.
inline int styleOf(const SchemeSpec& scheme, std::size_t place) {
    return scheme.style.value_or(static_cast<int>(place));
}

/// Initial data: q and p or v of models with coordinates; other models have keys of their own.
struct Initial {
    enum class Second { none, momentum, velocity, position };
    std::vector<Number> q;
    Second second = Second::none;
    std::vector<Number> pOrV;  ///< second: momentum, velocity, or the position at a later time
    std::optional<Number> at;  ///< Second::position: how much later
    bool isProjected = false;  ///< q may be moved onto the constraints of the model, however far
    Settings given;            ///< the keys of ModelEntry::initial; type empty
    bool operator==(const Initial&) const = default;
};

struct ReferenceSpec {
    enum class Kind { automatic, exact, none, scheme, file, companion };
    Kind kind = Kind::automatic;
    std::vector<SchemeSpec> scheme;  ///< one entry for Kind::scheme
    std::string path;                ///< Kind::file
    bool operator==(const ReferenceSpec&) const = default;
};

/// Something to look for along every motion: where an expression in the state passes zero. reflect: the
/// motion does not pass it, and bounces with the restitution (scene/reflections.hpp). change: a parameter of
/// the model takes another value there (scene/switches.hpp).
struct EventSpec {
    enum class Direction { both, up, down };
    enum class Action { write, count, stop, reflect, change };
    std::string expression;
    std::string label;  ///< empty: the expression
    Direction direction = Direction::both;
    Action action = Action::write;
    std::vector<std::pair<std::string, double>> values = {};  ///< of the model's parameters in it
    double restitution = 1;                                   ///< of reflect
    std::string parameter = {};                               ///< of change: its name
    Number value = {};                                        ///< of change: what it is from then on
    const std::string& title() const { return label.empty() ? expression : label; }
    /// Another value of a parameter in the expression.
    void setParameter(std::string_view name, double number) {
        for (auto& each : values)
            if (each.first == name) each.second = number;
    }
    bool operator==(const EventSpec&) const = default;
};

/// How the window shows the scene when it is opened, besides its views.
struct Shown {
    std::optional<Number> time;    ///< of the cursor and of the stage; empty: the scene plays
    std::optional<Number> pinned;  ///< of the second cursor, from which differences are taken
    std::optional<PageLayout> layout;
    bool operator==(const Shown&) const = default;
};

struct Scene {
    std::string title, source, lesson, notes;
    Settings model;
    Initial initial;
    Number start, end;
    std::vector<SchemeSpec> schemes;
    ReferenceSpec reference;
    std::vector<std::string> observe;
    std::vector<std::string> sensitivity;  ///< pointers to numbers to differentiate by; empty: all parameters
    std::vector<EventSpec> events;
    std::optional<Number> every;  ///< output.every
    bool isDense = false;         ///< output.dense
    std::vector<View> views;
    Shown shown;
    double maxSteps = 1e11;  ///< limits.steps

    // Compiled once.
    Scene();
    Scene(const Scene&);
    Scene(Scene&&) noexcept;
    Scene& operator=(const Scene&);
    Scene& operator=(Scene&&) noexcept;
    ~Scene();
    bool operator==(const Scene&) const;
};

}  // namespace extremal
