// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/space/smooth_panels.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/algebra/long_numbers.hpp"
#include "engine/quadrature/rule.hpp"

namespace extremal {
namespace {

constexpr std::size_t panelOrder = 12;
constexpr double accepted = 1e-24;
/// From this width on the defect tells how smooth a function is at the place that it comes from.
constexpr double narrow = 1.0 / 256;
/// A place is known well enough to be printed, and a function that is smooth at all was accepted before.
constexpr double narrowest = 1e-11;
/// Off the middle: no round number is ever met.
constexpr double division = 0.4871;

const Rule<Quad>& panelRule() {
    static const Rule<Quad> rule = gauss<Quad>(static_cast<int>(panelOrder));
    return rule;
}

class Search {
public:
    Search(const SampledFunctions& functions, int count, std::size_t mostPanels)
        : functions_(functions),
          count_(static_cast<std::size_t>(count)),
          mostPanels_(mostPanels),
          scale_(count_, Quad(0)) {
        for (int i = 0; i <= 16; ++i) {
            const auto [value, slope] = at(Quad(i) / 16);
            for (std::size_t a = 0; a < count_; ++a)
                if (isfinite(value[a])) scale_[a] = std::max(scale_[a], Quad(abs(value[a])));
        }
    }

    SmoothPanels run(std::span<const __float128> cells) {
        result_.ends.push_back(cells.front());
        for (std::size_t j = 1; j < cells.size() && result_.fault == SmoothPanels::Fault::none; ++j) {
            cellStart_ = cells[j - 1];
            cellEnd_ = cells[j];
            divide(cells[j - 1], cells[j], nullptr, nullptr);
        }
        return result_;
    }

private:
    struct Values {
        std::vector<Quad> value, slope;
    };
    /// A panel that another is a part of.
    struct Outer {
        double width;
        std::vector<double> defect;
    };

    Values at(const Quad& tau) const {
        std::vector<__float128> v(count_), d(count_);
        functions_(tau.backend().value(), v, d);
        return {{v.begin(), v.end()}, {d.begin(), d.end()}};
    }

    void fail(SmoothPanels::Fault fault, std::size_t function, const Quad& place, double exponent = 0) {
        result_.fault = fault;
        result_.function = static_cast<int>(function);
        result_.place = static_cast<double>(place);
        result_.exponent = exponent;
    }

    /// Relative defects; none where a value is not finite, which is then the result.
    std::vector<double> defects(const Quad& a, const Quad& b) {
        const Values start = at(a), end = at(b);
        std::vector<Quad> sum(count_, Quad(0)), size(count_, Quad(0));
        const auto isSound = [&](const std::vector<Quad>& all, const Quad& tau) {
            for (std::size_t f = 0; f < count_; ++f)
                if (!isfinite(all[f])) {
                    fail(SmoothPanels::Fault::notFinite, f, tau);
                    return false;
                }
            return true;
        };
        if (!isSound(start.value, a) || !isSound(end.value, b)) return {};
        for (std::size_t i = 0; i < panelOrder; ++i) {
            const Quad tau = a + (b - a) * panelRule().c[i];
            const Values v = at(tau);
            if (!isSound(v.value, tau) || !isSound(v.slope, tau)) return {};
            for (std::size_t f = 0; f < count_; ++f) {
                sum[f] += (b - a) * panelRule().b[i] * v.slope[f];
                size[f] += abs((b - a) * panelRule().b[i] * v.slope[f]);
            }
        }
        std::vector<double> defect(count_);
        for (std::size_t f = 0; f < count_; ++f) {
            const Quad whole = scale_[f] + size[f];
            defect[f] =
                whole > 0 ? static_cast<double>(abs(end.value[f] - start.value[f] - sum[f]) / whole) : 0;
        }
        return defect;
    }

    /// `first`: the first narrow panel on the way down; `last`: the one that was divided.
    void divide(const Quad& a, const Quad& b, const Outer* first, const Outer* last) {
        if (result_.fault != SmoothPanels::Fault::none) return;
        const Outer here{static_cast<double>(b - a), defects(a, b)};
        const auto& [width, defect] = here;
        if (defect.empty()) return;
        // A whole cell is divided once: kinks in its middle escape a symmetric rule.
        const bool isAccepted =
            last && std::all_of(defect.begin(), defect.end(), [](double d) { return d <= accepted; });
        if (first && (isAccepted || width < narrowest) && isRough(a, b, here, *first, *last)) return;
        if (isAccepted || width < 1e-18) {
            result_.ends.push_back(b.backend().value());
            return;
        }
        if (result_.ends.size() >= mostPanels_) {
            const auto worst = std::max_element(defect.begin(), defect.end()) - defect.begin();
            return fail(SmoothPanels::Fault::tooMany, static_cast<std::size_t>(worst), a);
        }
        if (!first && width <= narrow) first = &here;
        const Quad middle = a + (b - a) * Quad(division);
        divide(a, middle, first, &here);
        divide(middle, b, first, &here);
    }

    /// Whether a defect has fallen too slowly on the way down, also in the last division: parts beside the
    /// place where a function is not smooth fall at once. That is then the result.
    bool isRough(const Quad& a, const Quad& b, const Outer& here, const Outer& first, const Outer& last) {
        if (here.width > first.width / 4) return false;
        std::size_t worst = count_;
        double least = 7.5;
        for (std::size_t f = 0; f < count_; ++f) {
            const auto rate = [&](const Outer& outer) {
                return std::log(outer.defect[f] / std::max(here.defect[f], 1e-36)) /
                       std::log(outer.width / here.width);
            };
            if (!(first.defect[f] > accepted) || rate(last) > 30 || rate(first) >= least) continue;
            least = rate(first);
            worst = f;
        }
        if (worst == count_) return false;
        // One-sided powers are integrated well by panels that become narrower towards the end.
        const bool isAtStart = a - cellStart_ <= 4 * (b - a), isAtEnd = cellEnd_ - b <= 4 * (b - a);
        if ((isAtStart || isAtEnd) && least > 0.9) return false;
        const Quad place = isAtStart ? cellStart_ : isAtEnd ? cellEnd_ : (a + b) / 2;
        using Fault = SmoothPanels::Fault;
        // A pole is not met exactly.
        if (std::max(Quad(abs(at(a).value[worst])), Quad(abs(at(b).value[worst]))) > 1e3 * scale_[worst]) {
            fail(Fault::notFinite, worst, place);
            return true;
        }
        fail(least < 0.15  ? Fault::jump
             : least < 0.9 ? Fault::infiniteSlope
                           : Fault::kink,
             worst, place, least);
        return true;
    }

    const SampledFunctions& functions_;
    std::size_t count_, mostPanels_;
    std::vector<Quad> scale_;
    Quad cellStart_, cellEnd_;
    SmoothPanels result_;
};

}  // namespace

SmoothPanels smoothPanels(const SampledFunctions& functions, int count, std::span<const __float128> cells,
                          std::size_t mostPanels) {
    return Search(functions, count, mostPanels).run(cells);
}

PanelNodes panelNodes(std::span<const __float128> ends) {
    PanelNodes all;
    for (std::size_t j = 1; j < ends.size(); ++j)
        for (std::size_t i = 0; i < panelOrder; ++i) {
            const Quad a = ends[j - 1], length = Quad(ends[j]) - a;
            all.node.push_back((a + length * panelRule().c[i]).backend().value());
            all.weight.push_back((length * panelRule().b[i]).backend().value());
        }
    return all;
}

}  // namespace extremal
