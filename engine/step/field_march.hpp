// SPDX-License-Identifier: GPL-3.0-or-later
/// What all integrators of fields share, whatever their functions in space: two buffers and dense output.
///
/// A step writes u and v at the new level into a buffer, which is exchanged with the state: nothing is
/// copied, and the state is as it was where a step fails. What is not finite is seen by the step itself.
/// Internal to the families and the baselines of fields.
#pragma once

#include <memory>
#include <vector>

#include "engine/integrator/integrator.hpp"
#include "engine/model/field/spatial_form.hpp"

namespace extremal {

/// One-step methods for the values of a field.
class FieldMarch : public Integrator {
public:
    FieldMarch(std::shared_ptr<const SpatialForm> form, double step);
    /// Of n values without form(), free unless isHeld() says otherwise.
    FieldMarch(std::size_t n, double step);

    double stepSize() const final { return h_; }
    void setStep(double h) final;
    bool checksFinite() const final { return true; }
    StepReport advance(State& state, double until) final;
    /// A shorter step from the level before, made on each use.
    void denseOutput(double tau, std::span<double> x) const final;

    /// Of the values at nodes that are not fixed, and of their momenta M v.
    std::size_t tangentSize() const final { return hasVariations() ? 2 * freeNodes().size() : 0; }
    bool applyTangent(std::span<double> W) final;
    bool checkpoint(Archive& archive) override;

protected:
    /// Whether a step has a tangent map: then linearise() prepares that of the last one, and vary() moves one
    /// variation (du, dp) by it, n() numbers each and 0 at fixed nodes. False where it is singular.
    virtual bool hasVariations() const { return false; }
    virtual bool linearise() { return false; }
    virtual void vary(std::vector<double>& /*du*/, std::vector<double>& /*dp*/) {}
    /// The Hessian of U at u, by elements; and df -= scale H du.
    std::vector<double> hessianAt(const double* u) const;
    void addForceChange(const std::vector<double>& hessian, const double* du, double scale, double* df) const;

    /// From level x to level `next`, u then v each. Called after prepare(). What is not finite is found
    /// afterwards, unless the step says that it looked itself.
    virtual Outcome step(const double* x, double* next, StepReport& report) = 0;
    /// Before the first step of a size.
    virtual void prepare() {}

    const SpatialForm& form() const { return *form_; }
    /// Whether number i of u stays as it is.
    virtual bool isHeld(std::size_t i) const;

    static bool isFinite(const std::vector<double>& x);

    std::size_t n() const { return n_; }
    double h() const { return h_; }
    /// Of the level that the last step began at, or the one under way.
    double begin() const { return begin_; }
    void setChecked() { isChecked_ = true; }
    /// The level before that of the state, after a step.
    const std::vector<double>& before() const { return other_; }

private:
    std::shared_ptr<const SpatialForm> form_;
    std::size_t n_;
    double h_, begin_ = 0;
    const std::vector<std::size_t>& freeNodes() const;

    bool isPrepared_ = false, isChecked_ = false;
    mutable std::vector<std::size_t> freeNodes_;  ///< of variations, made when they are asked for
    std::vector<double> du_, dp_;
    std::vector<double> other_;  ///< the next level during a step, the one before after it
};

}  // namespace extremal
