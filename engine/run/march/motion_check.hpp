// SPDX-License-Identifier: GPL-3.0-or-later
/// Whether a run is still the motion that it began: the outcome `lost` of runs that have no other fault.
///
/// Steps may go on for ever, finite all the time, while the solution has long left the problem: an explicit
/// scheme beyond its stability limit, or a step whose equations have another root. What gives it away is the
/// quantity that the motion cannot change: the energy of a conservative system, the norm of a wave function.
/// A run is lost at the first node that is looked at where
///
///     |H(t) - H(0)| > 100 S,      S: the size of the energies that the motion has at all.
///
/// S is the largest of |H(0)| and of the kinetic energies seen so far, as H alone may be small by the choice
/// of its zero. Only nodes count whose energy is right within half the kinetic energy: in an unstable run
/// the kinetic energy grows with the error, and S stays what the motion has. A motion that starts at rest
/// has at least the kinetic energy that the forces at the start give in one step.
///
/// Why 100: the energy of a stable symplectic scheme stays within a band, which is wide close to the limit of
/// stability. Of Stoermer-Verlet on an oscillator it is at most 1/(1 - (h w/2)^2) times the energy, so that
/// only steps within half a percent of the limit are taken for lost. Beyond a limit energies grow
/// exponentially, and a collision that is jumped over shoots a body out at many times its energy: no larger
/// number is needed to see either.
///
/// A run can be out of its motion with less: a body that a coarse step shoots out of a bounded orbit has a
/// multiple of the energy that it should have, but not of the kinetic energy that it had closest to the
/// centre. So a run is lost at its end, too, where for at least half of its time
///
///     H(t) - H(0) > K/2 and > S/10,      K: the mean kinetic energy over the time so far.
///
/// The energy of a stable scheme comes back, of a dissipative one it falls; this is energy that has come from
/// nowhere and stays. It may have gone again by then: a step over the pole of spherical coordinates, whose
/// barrier p_phi^2 / (2 sin^2 theta) it did not see, gives seven times the energy for half of a run, and a
/// later one takes it away; K says nothing any more. So a run is lost at its end, too, where for 8 nodes in
/// a row, and a thirty-second of its time, it has had
///
///     H(t) - H(0) > S/2,   constant to a quarter.
///
/// No stable scheme has that: close to the limit of an oscillator the error A sin^2 beats once in
/// pi/2 sqrt(1 + A/S) nodes, and stays within a quarter of its largest value for 0.3 of a beat, which is 5
/// nodes where A is 100 S.
///
/// The energy is computed at the nodes 1, 2, 4, ..., 64, at one of every 64 from there on and at the last
/// one, whatever the blocks of steps (march.hpp), whose sizes follow the clock: a lost run ends at the first
/// of these that is out of bounds. The nodes are at changing distances, and while there is such a gain or
/// shift every node is looked at, so that no oscillation is taken for constant.
///
/// A step may also jump over the edge of the region in which L is defined (of log(x), to x < 0), to a finite
/// state with finite forces: 1 - 1/x is as good there as anywhere. What gives it away is that H is not a
/// number. Such a run, conservative or not, ends at the last node before. What is guaranteed:
///
///   * Where H of some finite states is not a number, every node is looked at. Such states are sought once,
///     around the start: 32 of them, by the signs of their entries and by sizes from a hundredth to a hundred
///     times those of the start (fewer of wide states). No states are tried of moving meshes, which are
///     looked at everywhere, and where H is defined everywhere, as that of wave functions and membranes
///     (System::blocks).
///   * Where the run computes H at every node in any case, the one who does so ends it (state_values.hpp);
///     `isEnergySeen` tells.
///   * Everywhere else H is finite but for overflow, and the run ends at one of the nodes above.
///
/// A problem may say itself where its states are not resolved any more (ValidityLimit): every node is looked
/// at then, and the run ends as under-resolved.
///
/// H that is unknown because no velocity is found for a momentum says nothing of the motion.
#pragma once

#include <functional>

#include "engine/core/node_block.hpp"
#include "engine/core/text/archive.hpp"
#include "engine/core/outcome.hpp"
#include "engine/model/parts/validity_limit.hpp"
#include "engine/model/system.hpp"

namespace extremal {

class MotionCheck {
public:
    static constexpr double band = 100;

    /// Keeps what it needs of the system. Where nothing is conserved it finds nothing wrong but energies that
    /// are not numbers. `step`: 0 where it is not known. `isEnergySeen`: by others, at every node.
    MotionCheck(const System& system, const State& start, double step, bool isEnergySeen = false);

    /// How many of these nodes, in order, still belong to the motion. `isLast`: the run ends with them.
    std::size_t soundNodes(const NodeBlock& nodes, bool isLast);

    /// S, as far as it is known; 0 where nothing is conserved.
    double scale() const { return scale_; }

    /// For whoever goes on with a lost run: node by node, in order. Learns S, and whether the energy is
    /// a number and, where it is conserved, within bounds at this one.
    bool isSound(double t, const double* x);
    /// The energy at a node, from who computes it at every node (`isEnergySeen`): no step is overlooked then.
    void noteEnergy(double t, double energy) {
        if (conserved_ && isConservedEnergy_ && kinetic_) noteShift(t, energy - start_);
    }
    /// Why the last node that was not sound is not: lost, or under-resolved (ValidityLimit).
    Outcome outcome() const { return isUnresolved_ ? Outcome::underResolved : Outcome::lost; }
    /// Whether the last node that was not sound has an energy that is not a number.
    bool hasLeftDomain() const { return hasLeftDomain_; }
    /// Whether it is to be shown this node.
    bool looksAt(long long node) const;
    /// Of a run that ends at the last node that isSound() has seen: whether energy has come and stayed.
    bool hasGained() const;
    /// The part of it that noteEnergy() tells.
    bool hasShifted() const;
    /// What it has learned.
    void checkpoint(Archive& archive) {
        archive(scale_, lastTime_, work_, gainTime_, gains_);
        archive(shiftTime_, leastShift_, mostShift_, longestShift_, shifted_);
    }

private:
    using OfState = std::function<double(double t, const double* x)>;

    bool isDefined(double t, const double* x, double energy);
    void noteGain(double t, double change, double kinetic);
    void noteShift(double t, double change);
    double gainedKineticEnergy(const System& system, const State& start, double step) const;

    OfState conserved_, kinetic_;  ///< empty: nothing is conserved; nothing is known of the parts
    OfState energy_;               ///< empty: there is no energy, or it is not a number from the start
    std::function<bool(double t, const double* x)> hasVelocity_;  ///< empty: every state has one
    bool isConservedEnergy_ = false;                              ///< conserved_ is the same as energy_
    bool hasEdge_ = false;                                        ///< there are states without an energy
    bool isEnergySeen_ = false;
    bool hasLeftDomain_ = false;
    ValidityLimit::Holds isResolved_;  ///< empty: nothing ends it
    bool isUnresolved_ = false;
    double start_ = 0, scale_ = 0;
    double startTime_ = 0, lastTime_ = 0, work_ = 0;  ///< work: kinetic energy times time
    double gainTime_ = 0;                             ///< the last node without a gain
    int gains_ = 0;                                   ///< nodes behind it
    /// Since when the energy is too large by the same, the least and the most of that, and for how many
    /// nodes; and the longest such time.
    double shiftTime_ = 0, leastShift_ = 0, mostShift_ = 0, longestShift_ = 0;
    int shifted_ = 0;
};

}  // namespace extremal
