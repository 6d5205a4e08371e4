// SPDX-License-Identifier: GPL-3.0-or-later
/// Poses of a rotating body from states and back: states of a body, or of a group given as data that is one
/// in other coordinates (model/group/body_form.hpp).
///
/// On a group the pose that was written last is kept and taken again where the state is still the one
/// written: what a matrix tells of its rotation, and T^-T J of J, would move in the last digit otherwise.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "engine/core/text/archive.hpp"
#include "engine/family/lie/lie_groups.hpp"
#include "engine/model/group/body_form.hpp"

namespace extremal {

class BodyPoses {
public:
    using Group = RotationGroup<double>;

    explicit BodyPoses(std::optional<BodyForm> form = {}) : form_(std::move(form)) {}

    Pose<double> read(const std::vector<double>& x) const {
        if (!form_) return Group::read(x.data());
        if (x == written_) return last_;
        Pose<double> p;
        form_->read(x.data(), p.attitude, p.momentum);
        return p;
    }
    void put(const Pose<double>& p, double* x) const {
        form_ ? form_->write(p.attitude, p.momentum, x) : Group::write(p, x);
    }
    void write(const Pose<double>& p, std::vector<double>& x) {
        put(p, x.data());
        if (!form_) return;
        last_ = p;
        written_ = x;
    }
    void forget() { written_.clear(); }
    void checkpoint(Archive& archive) { archive(last_.attitude, last_.momentum, written_); }

    /// Columns of variations, six numbers each: those of the state to those of the body, and back.
    void varyBody(double* W, int columns) const {
        for (int k = 0; form_ && k < columns; ++k) form_->varyBody(W + 6 * k);
    }
    void varyState(double* W, int columns) const {
        for (int k = 0; form_ && k < columns; ++k) form_->varyGroup(W + 6 * k);
    }

private:
    std::optional<BodyForm> form_;
    Pose<double> last_;
    std::vector<double> written_;
};

}  // namespace extremal
