// SPDX-License-Identifier: GPL-3.0-or-later
/// Frames of a field along a run, within a fixed amount of memory.
///
/// Every row is offered. As long as all fit, all are stored; when the budget is exceeded, every second one is
/// dropped, and from then on only every second (fourth, ...) row is stored, so that the frames remain evenly
/// spread over the rows. The first row and the last one offered are always among them.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "engine/core/text/archive.hpp"

namespace extremal {

/// Values of a field at its nodes (model/system.hpp, FieldSampling), shared: copies are cheap.
struct Frame {
    double t = 0;
    std::shared_ptr<const std::vector<double>> values;

    void checkpoint(Archive& archive) {
        std::vector<double> all = values ? *values : std::vector<double>();
        archive(t, all);
        if (archive.isReading()) values = std::make_shared<const std::vector<double>>(std::move(all));
    }
};

class FrameKeeper {
public:
    /// In numbers: 8 MB per scheme, 64 MB for fields over a rectangle.
    static constexpr std::size_t usual = std::size_t{1} << 20, large = std::size_t{1} << 23;
    explicit FrameKeeper(std::size_t budget = usual) : budget_(budget) {}

    /// Whether the next row offered would be kept.
    bool wantsNext() const { return offered_ % stride_ == 0; }

    /// Offers a row: `make` fills the values if they are wanted, or if this is the last row.
    void offer(double t, bool isLast, const std::function<std::shared_ptr<const std::vector<double>>()>& make,
               std::vector<Frame>& frames) {
        const bool isRegular = wantsNext();
        if (isRegular || isLast) {
            if (frames.empty() || frames.back().t != t) frames.push_back({t, make()});
            if (isRegular) thin(frames);
        }
        ++offered_;
    }

    void checkpoint(Archive& archive) { archive(offered_, stride_); }

private:
    void thin(std::vector<Frame>& frames) {
        const std::size_t size = frames.back().values->size();
        if (frames.size() <= 2 || frames.size() * size <= budget_) return;
        std::size_t kept = 0;
        for (std::size_t i = 0; i < frames.size(); i += 2) frames[kept++] = frames[i];
        frames.resize(kept);
        stride_ *= 2;
    }
    std::size_t budget_, offered_ = 0, stride_ = 1;
};

}  // namespace extremal
