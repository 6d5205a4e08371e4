// SPDX-License-Identifier: GPL-3.0-or-later
/// A family of schemes: one folder engine/family/<id>, one constant, and one section of the paper. All that
/// is particular to it is there: its spaces and their keys, defaults, claims, checks before a run, stability,
/// cost, the reference it trusts, what the window offers, and its steps. Nothing outside the folder names it
/// (tests/tree); everybody else goes through the functions below the struct, which find the family of a
/// space.
///
/// Members that may be null say what stands in place of them. Functions throw InvalidScene with pointers
/// relative to the scheme only where they say so.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/family/choices.hpp"
#include "engine/family/discretization.hpp"
#include "engine/family/findings.hpp"
#include "engine/family/written_action.hpp"
#include "engine/integrator/integrator.hpp"
#include "engine/model/system.hpp"
#include "engine/space/catalog.hpp"
#include "engine/core/element_clocks.hpp"

namespace extremal {

template <class T>
struct Table;
struct Tableau;

/// A step that follows from the space: the length of an element.
struct ImpliedStep {
    double step = 0;
    std::string expression;  ///< in the model's parameters ("1/elements"); empty: the number alone
    bool isOfSpace = false;  ///< the space says it, so that a step given beside it is not used
};
/// The value of a parameter of the model; empty if it has none of that name.
using ParameterValue = std::function<std::optional<double>(std::string_view name)>;

/// A scheme before its run.
struct SchemeCase {
    const System& system;
    const State& initial;
    const Discretization& discretization;
    double step = 0;
    bool isComposed = false;
    bool allowsUnstable = false;
    double end = 0;  ///< of the run
};

/// The scheme that references of a system are computed with.
struct ReferencePlan {
    std::string description;  ///< "Gauss collocation of degree 12"
    std::function<std::unique_ptr<Integrator>(double step)> make;
    /// Its only step, with the error to expect; 0: steps are halved until two of them agree.
    double step = 0, expectedError = 0;
    /// Where halving begins; 0: at the period of the fastest motion, which it must resolve.
    double firstStep = 0;
};

/// References by a discretization, whose steps are halved until two of them agree.
ReferencePlan referenceBy(std::string description, const System& system, const Discretization& scheme);

/// The scheme that references of systems on meshes are computed with: on a mesh of its own.
struct ReferenceMesh {
    std::string description;
    Discretization discretization;
    double step = 0, elements = 0;
};

/// The function of a node, as a curve.
struct ShapeFunction {
    std::vector<double> x, phi;
    int node = 0, elements = 0;
};

/// Frequencies of plane waves on the mesh of a scheme, and of the field equation; NaN where they grow.
struct DispersionCurve {
    std::vector<double> waveNumber, frequency, exact;
};

struct Family {
    CatalogItem item;    ///< id: that of the folder
    std::string source;  ///< "Leok 2004, sec. 3"
    std::vector<SpaceEntry> spaces;
    std::vector<std::string> solverMethods;  ///< besides "auto"
    bool takesTensorRules = false;           ///< a rule for each direction: {"space": .., "time": ..}
    /// Whether a solution is read off between nodes; else it is made anew there, and solutions are compared
    /// at nodes.
    bool hasDenseOutput = true;
    /// Of the schemes of a space. free: the step of a scheme is its first. Null: fixed.
    TimeGrid (*grid)(const Settings& space) = nullptr;
    /// Its choices are further rows of the grid of another family, or a grid after it; that one is where the
    /// window starts from.
    bool isVariant = false;

    /// The binding parts that its steps understand, of some discretization; `mismatch` is for those that one
    /// of them lacks.
    Takes takes = Takes::only<Mechanical>();
    /// Whether a system of these parts can be used at all. Null: it can.
    bool (*suits)(const System&) = nullptr;
    /// The keys of the model at the resolution of a space; none where it has none of its own, so that the
    /// scheme is on the mesh of the scene. Null: spaces have none.
    std::optional<Settings> (*model)(const Settings& space, const Settings& model) = nullptr;
    /// The keys of the model on a mesh of `factor` times as many elements: orders are those of a refinement
    /// of the mesh and the step together, of all schemes for systems of the family. Null: of the step alone.
    Settings (*refined)(const Settings& model, int factor) = nullptr;
    /// The largest step that is stable, for what the window adds; infinity: every step is. Null: that of the
    /// harmonic oscillator at the highest frequency.
    double (*largestStep)(const System&, const Discretization&, const State& start) = nullptr;
    /// The state at the start, from the keys of /initial, of a space whose nodes are not those of the system;
    /// what follows from the initial data besides is decided in the discretization. Throws InvalidScene,
    /// pointers relative to the space. Null: System::start.
    State (*start)(const System&, Discretization&, const Settings& initial, double t) = nullptr;
    /// The state from which steps pass through the values of two levels, `step` apart, where the scheme can
    /// start so. Null: it starts from the state.
    State (*startThrough)(const System&, const Discretization&, double step, const State& first,
                          const State& second) = nullptr;
    /// Why a discretization cannot be used on a system of the family; empty if it can. Null: all can.
    std::string (*mismatch)(const Discretization&, const System&) = nullptr;
    /// The rule with its default keys; of an empty or automatic one the rule itself, where it does not depend
    /// on the step.
    Settings (*completeRule)(const Settings& space, const Settings& quadrature) = nullptr;
    /// What the start of a run decides (a frequency to be estimated). Null: nothing.
    Discretization (*estimate)(const Discretization&, const System&, const State& start) = nullptr;
    Properties (*describe)(const Discretization&) = nullptr;
    /// The same on a system, where it depends on that; none where it does not. Null: never.
    std::optional<Properties> (*describeOn)(const Discretization&, const System&) = nullptr;
    /// Null where the user gives the step.
    std::optional<ImpliedStep> (*impliedStep)(const Settings& space, const Settings& model,
                                              const ParameterValue&) = nullptr;
    /// What stands against a step, beyond the limits of the harmonic oscillator. Null: nothing.
    void (*check)(const SchemeCase&, Findings&) = nullptr;
    /// The highest frequency that the stability limit of Properties is to be multiplied with. Null: that of
    /// the system (highestFrequency).
    double (*frequency)(const Discretization&, const System&, const State&) = nullptr;
    /// Seconds that no step exceeds, for whether a trial of its cost is worth its time. Null: 5 ms.
    double (*slowestStep)(const SchemeCase&) = nullptr;
    /// What to try after a failure; empty: the usual. Null: the usual.
    std::string (*advice)(Outcome) = nullptr;
    /// Null where the family provides no reference; of families that are not the system's own (familyFor),
    /// `make` is empty where that one's is as good.
    ReferencePlan (*reference)(const System&, const State& start, double duration) = nullptr;
    /// Of systems on meshes, in place of `reference`: `refinement` 0, 1, .. doubles cells and steps. `step`:
    /// the shortest of the scene's schemes. Null: none.
    ReferenceMesh (*referenceMesh)(const Settings& model, double step, int refinement) = nullptr;
    ChoiceGrid (*choices)(const System&) = nullptr;
    /// The ids of the rules that a space can have, the preferred one first.
    std::vector<std::string> (*rules)(const Settings& space) = nullptr;
    /// Whether two complete discretizations are the same scheme; the steps of both are known. Null: the same
    /// space, degree, rule, nodes and panels.
    bool (*isSame)(const Discretization& a, double stepOfA, const Discretization& b) = nullptr;
    /// Of node `node` of a scheme with this step, where its space is made of functions of nodes. Null
    /// elsewhere.
    ShapeFunction (*shapeFunction)(const System&, const Discretization&, double step, int node) = nullptr;
    /// The elements of schemes that give each its own step, after `duration` and at x. Null: they do not.
    ElementClocks (*elements)(const System&, const Discretization&, double step, double duration,
                              const double* x) = nullptr;
    /// How fast waves run in a scheme. Null: it has no waves.
    DispersionCurve (*dispersion)(const System&, const Discretization&, double step) = nullptr;
    /// What schemes measure of themselves at nodes, for the observable of that id; none where they do not.
    /// Null: nothing.
    std::optional<Measure> (*measure)(std::string_view observable, const System&, const Discretization&,
                                      double step) = nullptr;
    /// Whether a discretization has one table for every system and step. Null: those of the family with
    /// `table`.
    bool (*hasTable)(const Discretization&) = nullptr;
    /// The one table of a space and a rule, where no system and no step is in it. Null where there is none.
    Table<double> (*table)(const Settings& space, const Settings& quadrature) = nullptr;
    /// The step as a Runge-Kutta method. Throws InvalidScene, with the reason, where it is not one. Null: no
    /// step is.
    std::shared_ptr<const Tableau> (*tableau)(const Discretization&, double step) = nullptr;
    /// The discrete action and its stationarity.
    WrittenAction (*written)(const Discretization&) = nullptr;
    /// Throws InvalidScene where it cannot.
    std::unique_ptr<Integrator> (*make)(const System&, const Discretization&, double step) = nullptr;
};

/// All families, in alphabetical order of their folders.
const std::vector<Family>& families();
/// The family of a space; null where there is no such space.
const Family* familyOf(const Settings& space);
/// The family that the window starts from for a system, and that references come from; null where none
/// applies.
const Family* familyFor(const System& system);
/// What the window offers for a system: the choices of that family, with further rows of its variants, and
/// then the grids of all other families that apply.
std::vector<ChoiceGrid> choiceGrids(const System& system);
/// The first of them.
ChoiceGrid choicesFor(const System& system);
const Family* findFamily(std::string_view id);

/// All spaces of all families.
const std::vector<CatalogItem>& spaceCatalog();

/// Keys must be checked and complete. Results are remembered, so that asking again is cheap.
Properties describe(const Discretization& discretization);
/// On a system: rules for terms and spaces for coordinates promise what its terms and coordinates allow.
Properties describe(const Discretization& discretization, const System& system);
inline Properties describe(const Settings& space, const Settings& quadrature) {
    return describe({space, quadrature, {}});
}

/// Fills in what depends on the other choice: the default number of nodes, and "auto" (or no) quadrature.
Settings completeQuadrature(const Settings& space, const Settings& quadrature);

/// Why a discretization cannot be used on a system; empty if it can.
std::string mismatch(const Discretization& discretization, const System& system);
inline bool isFor(const Discretization& discretization, const System& system) {
    return mismatch(discretization, system).empty();
}

/// With everything decided that depends on the start of a run.
Discretization withEstimates(const Discretization& discretization, const System& system, const State& start);

/// Makes the integrator of a discretization. Throws InvalidScene.
std::unique_ptr<Integrator> makeIntegrator(const System& system, const Discretization& discretization,
                                           const Clock& clock);

/// The ways to compute a reference of the system, the cheapest first; the last one is that of its own family.
std::vector<ReferencePlan> referencePlans(const System& system, const State& start, double duration);

/// The scheme that references of the system are computed with, for a run from a state. Throws InvalidScene
/// where there is none.
std::unique_ptr<Integrator> trustedIntegrator(const System& system, const State& start, double step);

/// Whether a discretization has one table for every system and step.
bool hasTable(const Discretization& discretization);
/// Highest frequency of the system at a state: its own, or, linearised there, the largest root w of
/// det(-L_qq - w^2 L_vv) = 0, or 0.
double highestFrequency(const System& system, const State& state);

}  // namespace extremal
