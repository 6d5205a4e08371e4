// SPDX-License-Identifier: GPL-3.0-or-later
/// What some baselines have and others have not: parts of a BaselineEntry, found by their type. A condition
/// on systems is a part as well (engine/family/parts/conditions.hpp).
#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "engine/core/catalog.hpp"
#include "engine/core/settings.hpp"
#include "engine/family/family.hpp"
#include "engine/family/findings.hpp"
#include "engine/model/system.hpp"

namespace extremal {

struct Tableau;

/// The claims of a baseline where they depend on its keys. Without it they are those of its item.
struct ClaimsOfKeys {
    static constexpr PartInfo part{"claims-of-keys", "claims that depend on keys", false};
    std::function<Claims(const Settings&)> of;
};

/// The claims where they depend on the kind of system, for as long as it is known. Without it they are the
/// same on all systems.
struct ClaimsOnSystem {
    static constexpr PartInfo part{"claims-on-system", "claims that depend on the system", false};
    std::function<Claims(const System&)> of;
};

/// The claims on one-forms, brackets, groups and spheres, whose flow is not canonical in the numbers of the
/// state. Without it they are those on other systems.
struct ClaimsWithoutCoordinates {
    static constexpr PartInfo part{"claims-without-coordinates", "claims that hold without coordinates",
                                   false};
    std::function<Claims(const Settings&)> of;
};

/// Of fields on meshes: the order in space, which compositions in time do not raise. Without it the order is
/// that of the step.
struct OrderInSpace {
    static constexpr PartInfo part{"order-in-space", "an order in space", false};
    int order = 0;
};

/// The largest step * frequency on the harmonic oscillator; infinity if every step is stable. Without it the
/// limit is not known, or there is no fixed step.
struct OscillatorLimit {
    static constexpr PartInfo part{"oscillator-limit", "a limit of stability", false};
    std::function<double(const Settings&)> of;

    explicit OscillatorLimit(double limit) : of([limit](const Settings&) { return limit; }) {}
    explicit OscillatorLimit(std::function<double(const Settings&)> ofKeys) : of(std::move(ofKeys)) {}
};

/// The step as a Runge-Kutta method, of its formula where steps are chosen by an error control. Throws
/// InvalidScene (pointer relative to the scheme) where the keys make no such method. Without it the baseline
/// is not a Runge-Kutta method, or its coefficients are not known.
struct BaselineTableau {
    static constexpr PartInfo part{"tableau", "a tableau", false};
    std::function<std::shared_ptr<const Tableau>(const Settings&)> of;
};

/// What is wrong or doubtful in its keys, pointers relative to the scheme. Without it only their ranges are
/// checked.
struct KeyCheck {
    static constexpr PartInfo part{"key-check", "a check of its keys", false};
    void (*examine)(const Settings&, Findings&) = nullptr;
};

/// What stands against a step, in place of the stability limit of the harmonic oscillator. Without it that
/// limit is checked.
struct StepCheck {
    static constexpr PartInfo part{"step-check", "a check of its step", false};
    void (*check)(const SchemeCase&, Findings&) = nullptr;
};

}  // namespace extremal
