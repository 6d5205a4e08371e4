// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plots/view_state.hpp"

#include <cmath>

#include "engine/view/axes.hpp"

namespace extremal {
namespace {

constexpr std::size_t longestHistory = 64;

}  // namespace

double ViewState::toAxis(PlotAxis axis, double value) const {
    return isLog(axis) ? std::log10(value) : value;
}

void ViewState::setFitted(PlotAxis axis, PlotRange range) {
    if (isDrawable(toAxis(axis, range.low), toAxis(axis, range.high), isLog(axis)))
        fitted_[index(axis)] = range;
}

PlotRange ViewState::range(PlotAxis axis) const {
    return current_.isChosen[index(axis)] ? current_.chosen[index(axis)] : fitted_[index(axis)];
}

void ViewState::remember() {
    if (!history_.empty() && history_.back() == current_) return;
    if (history_.size() == longestHistory) history_.erase(history_.begin());
    history_.push_back(current_);
}

void ViewState::chooseInAxisSpace(PlotAxis axis, double low, double high) {
    if (!isDrawable(low, high, isLog(axis))) return;
    current_.chosen[index(axis)] =
        isLog(axis) ? PlotRange{std::pow(10, low), std::pow(10, high)} : PlotRange{low, high};
    current_.isChosen[index(axis)] = true;
}

void ViewState::zoom(PlotAxis axis, double factor, double anchor) {
    const PlotRange r = range(axis);
    const double low = toAxis(axis, r.low), high = toAxis(axis, r.high), a = toAxis(axis, anchor);
    chooseInAxisSpace(axis, a + (low - a) * factor, a + (high - a) * factor);
}

void ViewState::pan(PlotAxis axis, double fromValue, double toValue) {
    const PlotRange r = range(axis);
    const double shift = toAxis(axis, fromValue) - toAxis(axis, toValue);
    chooseInAxisSpace(axis, toAxis(axis, r.low) + shift, toAxis(axis, r.high) + shift);
}

void ViewState::choose(PlotAxis axis, PlotRange range) {
    chooseInAxisSpace(axis, toAxis(axis, range.low), toAxis(axis, range.high));
}

bool ViewState::back() {
    while (!history_.empty()) {
        const View earlier = history_.back();
        history_.pop_back();
        if (earlier == current_) continue;
        left_.push_back({current_, earlier});
        current_ = earlier;
        return true;
    }
    return false;
}

bool ViewState::forward() {
    if (left_.empty() || left_.back().to != current_) {
        left_.clear();
        return false;
    }
    remember();
    current_ = left_.back().view;
    left_.pop_back();
    return true;
}

}  // namespace extremal
