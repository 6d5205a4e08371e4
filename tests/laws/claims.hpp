// SPDX-License-Identifier: GPL-3.0-or-later
/// The laws of claims: order, return, symplecticity and what is conserved, measured for a scheme on every
/// subject that it fits. A claim must hold on each of them, must have been measured on one, and what a named
/// scheme or a baseline does not claim it must miss on at least one, or it could claim it.
///
/// What is conserved goes by its name: "momentum", "energy" and "quadratic invariants" are those that systems
/// know; any other is the observable of that name ("bilinear form": bilinear-form), whose extreme stays 0.
/// Energy is conserved where it does not depend on time, and what has the addition " if H is constant". A
/// name that nothing measures is a broken law.
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tests/laws/catalogue.hpp"
#include "tests/laws/subjects.hpp"

namespace extremal::laws {

/// A scheme on one subject, with what is claimed of it.
struct Trial {
    const Subject& on;
    Claims claims;
    std::function<std::unique_ptr<Integrator>(double step)> make;
    bool isOrderVisible = true;  ///< in double precision: the errors of high degrees are round-off at once
    const Discretization* pair = nullptr;  ///< null: a baseline or a composition
    /// Whether the scheme has nothing against a step: steps near a resonance, or beyond a limit, claim
    /// nothing.
    std::function<bool(double step)> isSound = [](double) { return true; };
};
Trial trialOf(const Subject& on, const CatalogueScheme& scheme);

/// Slope of the error over the finest steps whose errors say something; none where the scheme is exact on the
/// system. Refinement ends early where the slope is the claimed one over a factor of 3 in the step.
std::optional<double> orderOf(const Trial& trial);

/// Distance from the start after some steps there and as many back; `each`: steps for the time of the
/// subject. Not a number where a step has no solution.
double returnDefect(const Trial& trial, double each);

/// How far a step is from keeping the symplectic form, relative to the largest entry of its derivative; for
/// wave functions, whose steps are linear, the change of an inner product. Not a number where it has no
/// solution.
double symplecticDefect(const Trial& trial, double each);

/// Largest change over 100 steps, relative to the size of what is conserved; none where the subject does not
/// have it. Steps that make the state grow without bound are shortened.
std::optional<double> conservedDefect(const Trial& trial, const std::string& what, double each);

/// What a scheme was found to do, over the subjects it fits.
struct Found {
    double nearestOrder =
        std::numeric_limits<double>::infinity();  ///< distance from the claim, where the scheme fits best
    double largestReturn = 0, largestSymplectic = 0;
    std::map<std::string, double> largestChange;                 ///< of what is claimed to be conserved
    std::map<std::string, double> largestInLongSteps;            ///< of what could be, and is not claimed
    int subjects = 0, orders = 0, returns = 0, derivatives = 0;  ///< measured
    std::vector<std::string> broken;

    std::string summary() const;
};

/// Adds what a trial shows.
void measure(Found& found, const Trial& trial);

/// Adds the claims that were measured on no subject.
void findGaps(Found& found, const CatalogueScheme& scheme);
/// Adds what is kept everywhere and not claimed; `on`: one of the subjects.
void findModesty(Found& found, const CatalogueScheme& scheme, const Subject& on);

/// A suite: the schemes of a group on all subjects of a kind, by their names.
class ClaimSuite {
public:
    ClaimSuite(SubjectKind kind, std::function<bool(const CatalogueScheme&)> isWanted);

    const std::vector<Subject>& subjects() const { return subjects_; }
    std::vector<std::string> names() const;
    Found examine(const std::string& name) const;
    /// Examines it and prints what was found; whether no law is broken.
    bool holds(const std::string& name) const;
    /// The scheme of that name on the first subject that it fits.
    const CatalogueScheme& scheme(const std::string& name) const;

private:
    std::vector<Subject> subjects_;
    std::map<std::string, std::vector<std::pair<const Subject*, CatalogueScheme>>> schemes_;
};

}  // namespace extremal::laws
