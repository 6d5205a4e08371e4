// SPDX-License-Identifier: GPL-3.0-or-later
/// What an impact does to variations of a state (dq, dp).
///
/// A step that ends at a contact has a length that depends on the state: with W and B the variations after it
/// at a fixed length and for a length of its own, gap_q (W_q + B_q dh) + gap_t (dt + dh) = 0. The impulse is
/// differentiated at the contact, along (dt + dh, dq, dp), by central differences of order 4; errors are
/// about 1e-11 of the largest entry. The next step begins later by dt + dh, and ends where it did: together
/// this is the saltation matrix between the tangent maps of the two steps, with the scheme's own steps in
/// place of the flow.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

#include "engine/core/state.hpp"
#include "engine/mechanism/mechanism.hpp"
#include "engine/mechanism/varied_step.hpp"
#include "engine/model/parts/wall.hpp"

namespace extremal {

class ImpactVariation {
public:
    using Matrix = Eigen::MatrixXd;
    using Row = Eigen::RowVectorXd;

    /// An impact after so many parts of a step.
    struct Contact {
        std::size_t pieces;
        int wall;
        State before;
    };

    explicit ImpactVariation(const Parts& parts);

    /// Moves 2 d rows of W, of the state before a step in parts, to `end`, after them. False where that is
    /// not known: where the step begins with an impact, or several happen at one time.
    bool throughImpacts(const std::vector<VariedStep*>& steps, const std::vector<Contact>& contacts,
                        const State& end, std::span<double> W);

private:
    /// Moves W, of a state before `step`, to the contact with `wall` at its end, through the impulse; `later`
    /// by how much that moves. `before`: the state at the contact, before the impulse. False where it is not
    /// known.
    bool throughContact(VariedStep& step, int wall, const State& before, Matrix& W, Row& later);
    /// Moves W from a time that is `later` back to that of the state.
    bool toNode(const State& at, Matrix& W, const Row& later);
    /// p after the impulse.
    bool strike(int wall, double t, const Eigen::VectorXd& x, Eigen::VectorXd& p);

    Mechanism mechanism_;
    Wall wall_;
    std::vector<double> gaps_, byPlace_, byTime_;
};

}  // namespace extremal
