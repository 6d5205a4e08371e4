// SPDX-License-Identifier: GPL-3.0-or-later
/// A system with its parameters in place: what a scene's "model" turns into.
///
/// A System is a bag of optional capabilities: a field that is empty is something the system does not have
/// (no exact solution, no conserved momentum, nothing to draw) or says in the usual way. A system with
/// coordinates has the state x = (q, p) and says nearly everything through its mechanics; one whose state is
/// something else (a body with an attitude, a wave function) names its columns and gives energy, error and
/// start itself. Ask through the functions below the struct, which know the usual ways. One file of
/// model/systems makes one entry.
///
/// Whoever runs, measures, writes or shows a system asks for the capability that it needs, never which kind
/// of problem it is. Four questions are easily taken for one another:
///     hasCoordinates()                 the state is (q, p)
///     parts.find<Mechanical>()         there is a Lagrangian to be evaluated
///     isMovedOnlyBy<Mechanical>()      nothing besides it moves the system, so that its formula is the whole
///     linearTestOf(system)             the linear motion that steps of its schemes are tested on
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/algebra/jet.hpp"
#include "engine/core/catalog.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/settings.hpp"
#include "engine/core/state.hpp"
#include "engine/model/body/body.hpp"
#include "engine/model/drawing.hpp"
#include "engine/model/exact_solution.hpp"
#include "engine/model/mechanics.hpp"
#include "engine/model/parts.hpp"

namespace extremal {

/// A generalised coordinate. Its state columns are "q.<name>" and "p.<name>".
struct Coordinate {
    std::string name;    ///< in files: "theta"
    std::string title;   ///< "angle"
    std::string symbol;  ///< in plots: "θ"
    std::string unit;    ///< "rad"; empty if dimensionless
    std::string momentumUnit;
};

/// A momentum that Noether's theorem conserves, as a function of the state.
struct MomentumMap {
    std::string name;  ///< column "momentum.<name>"
    std::string symbol;
    std::string unit;
    /// p = x + d; of a system without coordinates both are x.
    std::function<double(const double* q, const double* p)> value;
};

/// How far a state is from the reference at the same time.
struct ErrorMeasure {
    std::vector<Quantity> columns;  ///< "error", the size that counts, then its parts
    double scale = 1;               ///< size of what is compared: round-off is relative to it
    bool isOfPhase = false;         ///< of an angle or phase that grows with t, known to its round-off only
    /// One value per column.
    std::function<void(const double* x, const double* reference, double* values)> evaluate;
    /// Of a field, the L2 norm of the distance of the function with the values x from the solution, which is
    /// known at all places. May be empty.
    std::function<double(double t, const double* x, const ExactSolution& reference)> ofFunction = {};
    /// The same as evaluate() for a state whose nodes move: against a field that is known at all places.
    /// Takes the place of evaluate() where it is; may be empty.
    std::function<void(double t, const double* x, const ExactSolution& reference, double* values)>
        evaluateField = {};
};

/// The energy at (t, x).
using EnergyFunction = std::function<double(double t, const double* x)>;

/// What a field is sampled as, at nodes in space: for files, profiles and carpets. Rows do not hold it; runs
/// keep a bounded number of frames.
struct FieldSampling {
    std::vector<double> x;                ///< the nodes
    std::vector<double> y;                ///< of a rectangle, the nodes in its second direction; else empty
    std::vector<std::string> components;  ///< "re", "im"
    std::size_t places() const { return x.size() * (y.empty() ? 1 : y.size()); }
    /// The two components are the real and the imaginary part of one function; else the first is a real one.
    bool isComplex = false;
    /// The graph of a function over an interval, beside which its exact solution is drawn.
    bool isGraph = false;
    double period = 0;  ///< along x: the first node is met again after it; 0: not periodic
    /// The interval that the nodes along x divide into cells, and that along y of a rectangle. Length 0: it
    /// is what the nodes span.
    struct Interval {
        double left = 0, length = 0;
    };
    Interval along{}, across{};
    /// Of functions that vanish at both ends and whose nodes are too far apart for straight lines: makes the
    /// way from a sample to the same components at the middles of `rows` equal cells of `along`. May be
    /// empty.
    using Resampling = std::function<std::vector<double>(const std::vector<double>& sample)>;
    std::function<Resampling(int rows)> resampling;
    /// Values of a sample behind those of the places: for the drawing alone, and for `initial`.
    std::size_t further = 0;
    std::vector<std::array<double, 2>> furtherNodes = {};  ///< of u, which these begin with; may be empty
    /// Whether u stays as it is at a node of the first component, or at one of `furtherNodes`. Empty:
    /// nowhere.
    std::function<bool(std::size_t node)> isHeld;
    /// The initial data of a scene that starts with a sample; empty where it lacks a part of the state.
    std::function<Value(std::span<const double> values)> initial;
    std::size_t size() const { return places() * components.size() + further; }
    /// The nodes move: x is where they are before any state is known, and a sample ends with their places
    /// (`further`).
    bool hasMovingNodes = false;
    /// Component after component, each at all places, along x first.
    std::function<void(const double* state, double* values)> sample;
    /// The nodes of a sample.
    std::span<const double> nodesOf(const std::vector<double>& values) const {
        if (!hasMovingNodes) return x;
        return std::span<const double>(values).last(x.size());
    }
    explicit operator bool() const { return static_cast<bool>(sample); }
};

class Hamiltonian;
struct FieldProblem;
struct MembraneProblem;
class PlaneFieldProblem;
struct EllipticProblem;
struct StaticProblem;

// The parts that bind a motion (model/parts.hpp): what schemes are made for. Families and baselines ask for
// them; whoever shows, measures or writes a system asks for the capabilities of System below, and for the
// parts of model/parts, which do not bind.

using Mechanical = Mechanics<double>;  ///< a Lagrangian in coordinates: x = (q, p)
using Body = BodyMechanics<double>;    ///< a Lagrangian on a group
/// A wave function: the operator that moves it (model/wave/hamiltonian.hpp).
struct Wave {
    static constexpr PartInfo part{"wave", "a wave function"};
    std::shared_ptr<const Hamiltonian> hamiltonian;
};
/// A field over an interval: its Lagrangian and its mesh (model/field/problem.hpp).
struct ScalarField {
    static constexpr PartInfo part{"field", "a field"};
    std::shared_ptr<const FieldProblem> problem;
};
/// A membrane over a disc, on triangles (model/membrane/problem.hpp).
struct Membrane {
    static constexpr PartInfo part{"membrane", "a membrane"};
    std::shared_ptr<const MembraneProblem> problem;
};
/// A field over a periodic rectangle (model/plane_field/problem.hpp).
struct PlaneField {
    static constexpr PartInfo part{"plane-field", "a field over a rectangle"};
    std::shared_ptr<const PlaneFieldProblem> problem;
};
/// No motion, but an elliptic boundary-value problem along x (model/elliptic.hpp).
struct EllipticPart {
    static constexpr PartInfo part{"elliptic", "the elliptic problem"};
    std::shared_ptr<const EllipticProblem> problem;
};
/// No motion, but the profile with the least energy, along x (model/static_problem.hpp).
struct StaticPart {
    static constexpr PartInfo part{"static", "a static profile"};
    std::shared_ptr<const StaticProblem> problem;
};
/// Problems of one of these parts alone, which need nothing besides.
inline Takes plainProblems() {
    return Takes::only<Mechanical, Body, Wave, ScalarField, Membrane, PlaneField, EllipticPart, StaticPart>();
}

/// What a system measures of its own states, for the observable of that id.
struct Measure {
    std::string observable;  ///< "norm"
    std::vector<Quantity> columns;
    int extreme = -1;  ///< the column that is 0 where all is well; -1: none
    /// One value per column at (t, x). The function may keep buffers: each run has its own.
    using Evaluate = std::function<void(double t, const double* x, double* values)>;
    std::function<Evaluate(const State& initial)> bind;
};

/// x <- flow(x), of numbers and of numbers with their derivative along a variation; made from a function
/// generic in the number.
class FlowMap {
public:
    using Varied = Dual<double, 1>;
    template <class Map>
    FlowMap(Map map) : ofNumbers_(map), ofVaried_(map) {}
    void operator()(double* x) const { ofNumbers_(x); }
    void operator()(Varied* x) const { ofVaried_(x); }

private:
    std::function<void(double*)> ofNumbers_;
    std::function<void(Varied*)> ofVaried_;
};

/// A fast oscillation that a system knows of itself.
struct FastMotion {
    double frequency = 0;          ///< rad per unit of time, at rest; 0: none
    std::vector<int> coordinates;  ///< those that mainly oscillate fast; the others may as well
    /// At (t, x): energy of the oscillation around its slow mean, and that energy over the frequency of the
    /// moment, which slow motion changes by a small periodic part only. May be empty.
    EnergyFunction energy = {}, invariant = {};
    /// The Hamiltonian in parts, each with its exact flow over a given time: the oscillation alone, and the
    /// rest in one or more parts. May be empty.
    using Flow = FlowMap;
    std::function<Flow(double time)> fastFlow = {};
    std::vector<std::function<Flow(double time)>> slowFlows = {};
};

/// A slow model in place of the system: fewer unknowns y, their rate, and the state of the system that they
/// stand for.
struct ReducedMotion {
    std::vector<double> start;
    std::function<void(const double* y, double* rate)> rate;
    std::function<void(const double* y, double* x)> embed;
};
struct ReducedModel {
    std::string id;  ///< of the baseline that integrates it
    std::function<ReducedMotion(const State& initial)> make;
};

/// The linear motion that a step of a scheme is tested on (study/stability/linear_stability.hpp).
enum class LinearTest {
    none,
    oscillator,  ///< q'' = -w^2 q
    phases       ///< i c' = w c
};

/// Which entries of a state are of one kind, in their order.
struct StateBlocks {
    std::size_t attitude = 0;        ///< so many at the beginning are a quaternion of length 1
    std::vector<std::size_t> sizes;  ///< of the blocks behind them
};

struct System {
    std::string id;
    std::string independent = "t";  ///< what the schemes go along: time, or a place
    std::string timeUnit;           ///< "s", or empty if dimensionless
    std::string energyUnit;
    bool isSolvedAtOnce = false;  ///< along a place, from its boundary values
    bool hasSteps = true;         ///< of time, or distances of knots that schemes choose

    Parts parts;
    std::vector<Coordinate> coordinates;  ///< of systems with coordinates: x = (q, p)

    // Systems with another state.
    std::vector<Quantity> columns;  ///< what the first entries of x are: the state columns of every row
    EnergyFunction energy;
    EnergyFunction kineticEnergy;  ///< the part of it that tells the size of a motion
    /// How states of other sizes are made from a given one, to find out whether each has an energy. Without
    /// blocks: every finite state has one, or it is not known how to make others.
    StateBlocks blocks;
    /// The state is c, as re and im in turn, and the flow keeps the inner product of states and with it their
    /// norm, whether the energy changes or not.
    bool isUnitary = false;
    LinearTest linearTest = LinearTest::none;
    std::vector<Measure> measures;  ///< what else it measures of its states
    ErrorMeasure phaseError;        ///< of the phase, where a state has one; evaluate empty: none
    ErrorMeasure error;             ///< evaluate empty: the usual one of coordinates
    std::function<bool(double t, const double* x, double* dx)> rate;  ///< xdot, to draw what is between rows
    std::function<double(double t, const double* x)>
        frequency;  ///< of the fastest motion, rad per unit of time
    /// x at the start, at time t, from the checked keys of /initial (ModelEntry::initial). Throws
    /// InvalidScene, with pointers relative to /initial.
    std::function<std::vector<double>(const Settings& initial, double t)> start;
    /// Where initial data say more than a state does (the name of an exact solution): the exact solution that
    /// they start, or an empty function where none is known. Takes the place of `exact`.
    std::function<ExactSolution(const Settings& initial, const State& start)> exactFrom;
    /// Whether initial data are known at all times by the user's word, so that schemes start from two levels.
    std::function<bool(const Settings& initial)> givesLevels;

    FieldSampling field;
    std::string elementAxis = "X";  ///< the place of the elements of its mesh
    /// The state of a field at other places, as good as at its nodes: all u, then all u_t. May be empty.
    std::function<void(const double* x, std::span<const double> places, double* values)> at;
    /// What is doubtful in a state, for people ("under-resolved: .."); empty text where nothing is. May be
    /// empty.
    std::function<std::string(const double* x)> caution;

    FastMotion fast;
    std::vector<ReducedModel> reduced;
    std::vector<MomentumMap> momenta;
    /// Makes the exact solution through the initial state (t, x), or returns an empty function where there is
    /// none.
    std::function<ExactSolution(const State& initial)> exact;
    /// Shapes of one state, for the stage; of a field, x is a sample of it (FieldSampling).
    std::function<void(const double* x, Drawing& drawing)> draw;
    Inset inset;             ///< beside it
    bool isSpatial = false;  ///< the drawing fills space: seen from a corner, and turned by dragging
    /// The default phase portrait and trajectory: names of state columns.
    std::string phaseX, phaseY, trajectoryX, trajectoryY;
    bool hasPlanarTrajectory = false;  ///< the two trajectory columns are lengths in one plane
    /// Columns worth a plot against time each, where no plane holds the trajectory. Empty: up to three
    /// coordinates.
    std::vector<std::string> timePlots;

    // Compiled once.
    System();
    System(const System&);
    System(System&&) noexcept;
    System& operator=(const System&);
    System& operator=(System&&) noexcept;
    ~System();

    int dimension() const { return static_cast<int>(coordinates.size()); }
    /// Whether the state is x = (q, p), one pair per coordinate; whatever moves it.
    bool hasCoordinates() const { return !coordinates.empty(); }
    /// Whether the system has this part, and no other that binds its motion: what is written, drawn or sought
    /// by this part alone is the whole of it.
    template <class P>
    bool isMovedOnlyBy() const {
        return isTaken(Takes::only<P>(), parts);
    }
    /// Else it is solved at once along a place, from its boundary values.
    bool isMotion() const { return !isSolvedAtOnce; }
    /// A part that the system has. Throws std::logic_error where it does not.
    template <class P>
    const P& part() const {
        if (const P* const found = parts.find<P>()) return *found;
        throw std::logic_error(id + " has not " + std::string(P::part.title));
    }
    const Mechanical& mechanics() const { return part<Mechanical>(); }
    const Body& body() const { return part<Body>(); }
    const std::shared_ptr<const Hamiltonian>& hamiltonian() const { return part<Wave>().hamiltonian; }
    const FieldProblem& fieldProblem() const { return *part<ScalarField>().problem; }
};

/// Drops what is known of the motion by itself, where something comes to move it besides: exact solutions,
/// the error of the phase, the fast oscillation and reduced models.
void forgetKnownMotion(System& system);

/// The measure for an observable, or null.
const Measure* measureOf(const System& system, std::string_view observable);

/// Names of the first entries of the state: the system's own, else q.<name>, then p.<name>.
std::vector<Quantity> stateColumns(const System& system);
/// The energy, of the system itself or of its mechanics; empty where there is none. It keeps what it needs.
EnergyFunction energyOf(const System& system);
/// The kinetic energy likewise: p . v / 2 of a Lagrangian, 0 where no velocity is found for a momentum.
EnergyFunction kineticEnergyOf(const System& system);
/// Those of the system, or q and p.
StateBlocks blocksOf(const System& system);
/// That of the system; the oscillator for those that a Lagrangian in coordinates alone moves.
LinearTest linearTestOf(const System& system);
/// Whether a sum of squares has neither overflowed nor lost digits to underflow.
inline bool isSafeSquare(double sum) { return sum > 1e-280 && sum < 1e300; }
/// |x - y| of d numbers, of any size.
inline double scaledDistance(std::size_t d, const double* x, const double* y) {
    double sum = 0;
    for (std::size_t i = 0; i < d; ++i) sum = std::hypot(sum, x[i] - y[i]);
    return sum;
}
/// The usual measure of d coordinates: |q - q_ref|, |p - p_ref| and each q_i - q_ref,i. Norms whose squares
/// leave the range of numbers are computed again from scaled entries.
inline void coordinateError(std::size_t d, const double* x, const double* reference, double* values) {
    double q = 0, p = 0;
    for (std::size_t i = 0; i < d; ++i) {
        const double dq = x[i] - reference[i], dp = x[d + i] - reference[d + i];
        values[2 + i] = dq;
        q += dq * dq;
        p += dp * dp;
    }
    values[0] = isSafeSquare(q) ? std::sqrt(q) : scaledDistance(d, x, reference);
    values[1] = isSafeSquare(p) ? std::sqrt(p) : scaledDistance(d, x + d, reference + d);
}
/// The system's own measure, else the usual one.
ErrorMeasure errorMeasure(const System& system, const State& initial);
/// xdot at (t, x), of as many entries as there are columns of the state; false where it is not known.
bool rateOf(const System& system, double t, const double* x, double* dx);

struct ModelEntry {
    CatalogItem item;
    /// Initial data to start from when a user picks this model: q, then p, one per coordinate.
    std::vector<double> exampleQ, exampleP;
    /// Keys of the initial data of a model without coordinates, and the example.
    std::vector<FieldInfo> initial;
    Value::Object exampleInitial;
    double exampleEnd = 10, exampleStep = 0.05;
    std::function<System(const Settings& settings)> make;  ///< keys are checked and complete
    /// Throws InvalidScene (pointers below /model) where the system cannot start from a state; may be empty.
    std::function<void(const Settings& settings, const System& system, const State& initial)> checkInitial;
    /// Of a model with coordinates: its Lagrangian as a user would type it, in the names of the coordinates
    /// and, as parameters, those keys that are numbers. Null where there is none (a typed one says its own).
    std::string (*lagrangian)(const Settings& settings) = nullptr;
    /// Of a boundary-value problem: where its independent variable begins and ends, so that a scene need not
    /// say it; nothing where the settings do not tell. Null for motions.
    std::optional<std::pair<double, double>> (*interval)(const Settings& settings) = nullptr;
};

/// All systems, in alphabetical order of their ids; gathered from the files of model/systems.
const std::vector<ModelEntry>& modelCatalog();
/// The entry with this id, or null.
const ModelEntry* findModel(std::string_view id);

/// Whether a family, a baseline or an observable can be used on a system: it takes every part that the system
/// needs, and has nothing against it besides.
template <class Entry>
bool appliesTo(const Entry& entry, const System& system) {
    return isTaken(entry.takes, system.parts) && (!entry.suits || entry.suits(system));
}

}  // namespace extremal
