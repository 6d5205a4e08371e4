// SPDX-License-Identifier: GPL-3.0-or-later
/// What the equations of a step consist of, family by family: their matrix, their functions and their action,
/// for the views that show a discretization itself. One file of engine/family/<id>/equations makes one entry;
/// its name is that of the family.
///
/// Galerkin schemes and Lie groups say it in the same words: curves of a table in some coordinates, with a
/// Lagrangian there (LocalCoordinates), so that one algorithm serves both (action/saddle_point.hpp,
/// solve/discrete_lagrangian.hpp). Fields and wave functions have far more unknowns and give their matrix,
/// and fields their actions, themselves.
#pragma once

#include <Eigen/Core>

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/action/table.hpp"
#include "engine/action/unknown_block.hpp"
#include "engine/family/family.hpp"

namespace extremal {

/// A discretization on a system, from a state on.
struct StepCase {
    const System& system;
    const Discretization& discretization;
    const State& start;
    double step = 0;
};

/// How the functions of one unknown overlap with others; see run/kkt_pattern.hpp.
struct Supports {
    int functions = 0;
    bool isNodal = false;
    int termsAtNode = 0, othersAtNode = 0, othersInside = 0;
};

/// The matrix of the equations of a step, or of several, with every unknown in it.
struct StepMatrix {
    Eigen::MatrixXd magnitude;  ///< |entry|, in the order of the blocks
    std::vector<UnknownBlock> blocks;
    int elements = 0, dimension = 0;
    Supports supports;
    std::string failure;  ///< why there is no matrix; empty if there is one
};

/// Coordinates around a state in which the curves of a step are those of a table.
struct LocalCoordinates {
    Mechanics<double> mechanics;
    std::function<Eigen::VectorXd(const State&)> position;
    Eigen::VectorXd momentum;  ///< at the state itself
    int mostElements = 4;      ///< that share the coordinates
};

/// The action of one step between two states that a motion joins, and that of the motion.
struct ActionPair {
    double discrete = 0, exact = 0;
    double error = 0;  ///< what their difference is known to
};
/// For a step of length h from the start; none where the motion or the step is not found.
using ActionPairs = std::function<std::optional<ActionPair>(double h, const std::stop_token&)>;

/// The functions of a discretization in space, over an element or over the whole domain.
struct SpaceFunctions {
    struct Curve {
        std::string name;
        std::vector<double> x, y;
    };
    std::string axis;                    ///< "ξ" over an element, "x" over the domain
    std::vector<Curve> curves;           ///< at most a handful
    std::vector<double> nodes, weights;  ///< of the rule in space, if there is one
    std::string text;                    ///< "degree 2, 3 nodes"
};

/// One of the things that a family may say of its equations.
template <class Make>
struct EquationPart {
    Make make = nullptr;  ///< null: no scheme of the family has it
    /// Then, what the schemes are: "made of elements that step at times of their own".
    const char* instead = "";
    /// Why one discretization has none, in the same words; empty text: it has. Null: all have.
    std::string (*lacking)(const Discretization&) = nullptr;
    Takes of = Takes::everything();  ///< for which systems of the family `make` is; of others `instead`

    /// `instead`, of a system that has none; null where it has.
    const char* insteadOn(const System& system) const {
        return make && isTaken(of, system.parts) ? nullptr : instead;
    }
    std::string lackingOf(const Discretization& d) const {
        return !make ? instead : lacking ? lacking(d) : std::string();
    }
};

struct StepEquations {
    std::string family;
    EquationPart<StepMatrix (*)(const StepCase&)> matrix = {};
    const char* matrixTitle = "KKT matrix";
    /// "λ₂": the name of a block; null: z of degrees of freedom and p of multipliers.
    std::string (*blockName)(const UnknownBlock&, int elements) = nullptr;
    /// "16 of 200 cells": what of the system is in a matrix of so many elements and dimensions. Null: all.
    std::string (*extent)(const System&, int elements, int dimension) = nullptr;
    /// The functions in time with the rule. Throws InvalidScene where they do not exist.
    EquationPart<Table<double> (*)(const StepCase&)> functions = {};
    EquationPart<SpaceFunctions (*)(const StepCase&)> spaceFunctions = {};
    /// The action: of the table in the coordinates around a state, or by `actions`, where coordinates.make is
    /// null.
    EquationPart<LocalCoordinates (*)(const System&, const State&)> coordinates = {};
    EquationPart<ActionPairs (*)(const StepCase&)> actions = {};
    /// The order in time, where a mesh in space limits the order that is claimed. Null: the one claimed.
    int (*orderInTime)(const Discretization&) = nullptr;

    /// Why a discretization has no action; empty if it has one.
    std::string actionLackingOf(const Discretization& d) const {
        return coordinates.make ? coordinates.lackingOf(d) : actions.lackingOf(d);
    }
};

/// All entries, in alphabetical order of the families.
const std::vector<StepEquations>& stepEquations();
/// That of the family of a discretization. Every family has one.
const StepEquations& equationsOf(const Discretization& discretization);
/// The coordinates around a state of a system, from the family that has them; empty where there is none.
std::optional<LocalCoordinates> localCoordinates(const System& system, const State& start);

/// Those of a system with coordinates: its own, and the momenta of the state.
LocalCoordinates ownCoordinates(const System& system, const State& start);

/// What a system lacks for a part, for ViewEntry::missing: `what`, and what the schemes of its families are
/// instead. Empty where one of them has the part. `instead`: of a family; null: it has the part.
std::string missingEquations(const System& system, const std::string& what,
                             const char* (*instead)(const StepEquations&, const System&));

/// The KKT matrix of elements in the coordinates of `mechanics` (action/saddle_point.hpp), at the motion
/// through `nodes`, d x (elements + 1), from the momentum p0.
StepMatrix saddleMatrix(const Mechanics<double>& mechanics, const Table<double>& table, double t, double step,
                        const Eigen::MatrixXd& nodes, const Eigen::VectorXd& p0);
/// The same in the local coordinates of a system, along the motion of the scheme.
StepMatrix saddleMatrix(const StepCase& step, const Table<double>& table);

/// At most so many rows: a matrix that can be looked at.
inline constexpr int largestMatrix = 160;

}  // namespace extremal
