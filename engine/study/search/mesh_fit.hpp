// SPDX-License-Identifier: GPL-3.0-or-later
/// Two knobs of a field at once: N elements and n steps. What a few runs tell of all of them,
///
///     error = |A n^-p + s B N^-q|,   s = 1 or -1,   cost ~ N^a n^g,
///
/// with the claimed orders p and q or others near them, whichever fit best; s = -1 where a longer step makes
/// up for a coarse mesh, as in the leapfrog method. It begins with (N, n), (N, 2n) and (2N, 2n), or (N/2, 2n)
/// where N will do: of three such errors e1, e2, e3 the part of the time is |e1 - e2|/(1 - 2^-p), that of the
/// mesh |e2 - e3|/(1 - 2^-q). Then always the cheapest pair is run that should reach 0.9 of the wish, until
/// none is cheaper than what was found.
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace extremal {

struct MeshPair {
    int cells = 0;
    double steps = 0;
    double cost = 0;  ///< predicted
};

struct MeshRun {
    int cells = 0;
    double steps = 0;
    double error = std::numeric_limits<double>::infinity();  ///< infinity: failed, or cut off
    double cost = 0;
    bool isCutOff = false;    ///< it was not worth more
    bool isAccident = false;  ///< with more steps the wish was not reached
};

class MeshFit {
public:
    /// `cells`, `steps`: where it begins. Claimed orders, of which that in time may be higher. `least`: the
    /// fewest elements that the space has.
    MeshFit(int cells, double steps, int orderInTime, int orderInSpace, int least);

    /// The next run for an error of at most `wanted`; none where no cheaper pair is known to reach it.
    /// `most`: no run may cost more.
    std::optional<MeshPair> next(double wanted, double most) const;
    void take(const MeshRun& run);
    /// What the wish would cost if the claimed orders held from the best run on; 0: there is none yet.
    double promisedCost(double wanted) const;
    /// What was found there does not count.
    void reject(int cells, double steps);
    int firstCells() const { return cells_; }

    const std::vector<MeshRun>& runs() const { return runs_; }
    /// The cheapest run with an error of at most this; none: none has.
    const MeshRun* best(double wanted) const;
    /// Whether enough runs were made.
    bool isKnown() const { return model_.has_value(); }
    /// Of a mesh: the error that no shorter step improves; 0: not known.
    double floorOf(int cells) const;
    /// The error that all runs together let expect; 0: not known.
    double errorAt(double cells, double steps) const { return model_ ? model_->errorAt(cells, steps) : 0; }
    /// That of the costs, in units of those of the runs.
    double relativeCostAt(double cells, double steps) const {
        return std::pow(cells, byCells_) * std::pow(steps, bySteps_);
    }
    /// Of a number of steps, where the mesh is as fine as one likes; 0: not known.
    double timePart(double steps) const;

private:
    struct Model {
        double A = 0, B = 0, p = 0, q = 0, sign = 1, misfit = std::numeric_limits<double>::infinity();
        double errorAt(double cells, double steps) const;
    };
    std::optional<MeshPair> first(double wanted, double most) const;
    std::optional<MeshPair> cheapest(double wanted, double most) const;
    double costAt(double cells, double steps) const;
    bool isTooCoarse(double cells, double steps) const;
    bool isNew(int cells, double steps) const;
    void fit();

    int cells_, least_;
    double steps_;
    int orderInTime_, orderInSpace_;
    std::vector<MeshRun> runs_;
    std::optional<Model> model_;
    double byCells_ = 1, bySteps_ = 1;  ///< exponents of the cost
};

}  // namespace extremal
