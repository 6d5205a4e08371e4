// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/search/mesh_fit.hpp"

#include <algorithm>
#include <cmath>

namespace extremal {
namespace {

constexpr std::size_t mostPairs = 14;
constexpr double aimedAt = 0.9;      ///< of the wish that a pair is aimed at
constexpr double worthwhile = 0.95;  ///< of the cost of the best, below which another pair is run
constexpr double mostCells = 1 << 20, mostTimeSteps = 1e7;

bool isUsableRun(const MeshRun& run) { return std::isfinite(run.error) && run.error > 0; }

}  // namespace

MeshFit::MeshFit(int cells, double steps, int orderInTime, int orderInSpace, int least)
    : cells_(std::max(cells, least)),
      least_(least),
      steps_(std::max(1.0, std::round(steps))),
      orderInTime_(std::max(1, orderInTime)),
      orderInSpace_(std::max(1, orderInSpace)) {}

double MeshFit::Model::errorAt(double cells, double steps) const {
    return std::abs(A * std::pow(steps, -p) + sign * B * std::pow(cells, -q));
}

void MeshFit::take(const MeshRun& run) {
    runs_.push_back(run);
    fit();
}

void MeshFit::reject(int cells, double steps) {
    for (MeshRun& run : runs_)
        if (run.cells == cells && run.steps == steps) run.isAccident = true;
}

const MeshRun* MeshFit::best(double wanted) const {
    const MeshRun* least = nullptr;
    for (const MeshRun& run : runs_)
        if (run.error <= wanted && !run.isAccident && (!least || run.cost < least->cost)) least = &run;
    return least;
}

double MeshFit::promisedCost(double wanted) const {
    double least = HUGE_VAL;
    for (const MeshRun& run : runs_)
        if (isUsableRun(run))
            least = std::min(least, run.cost * std::pow(std::max(1.0, run.error / wanted),
                                                        1.0 / orderInTime_ + 1.0 / orderInSpace_));
    return std::isfinite(least) ? least : 0;
}

double MeshFit::floorOf(int cells) const {
    return model_ ? model_->B * std::pow(static_cast<double>(cells), -model_->q) : 0;
}

double MeshFit::timePart(double steps) const { return model_ ? model_->A * std::pow(steps, -model_->p) : 0; }

namespace {

/// Least squares of relative differences: e_i = signs_i (A a_i + s B b_i), with A and B at least 0.
struct FittedParts {
    double A, B, misfit;
};
FittedParts fittedParts(const std::vector<double>& a, const std::vector<double>& b,
                        const std::vector<double>& signs) {
    double aa = 0, ab = 0, bb = 0, ar = 0, br = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        aa += a[i] * a[i], ab += a[i] * b[i], bb += b[i] * b[i];
        ar += a[i] * signs[i], br += b[i] * signs[i];
    }
    const auto misfitOf = [&](double A, double B) {
        double sum = 0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            const double off = A * a[i] + B * b[i] - signs[i];
            sum += off * off;
        }
        return sum;
    };
    const double det = aa * bb - ab * ab;
    if (det > 1e-12 * aa * bb) {
        const double A = (bb * ar - ab * br) / det, B = (aa * br - ab * ar) / det;
        if (A >= 0 && B >= 0) return {A, B, misfitOf(A, B)};
    }
    const double onlyA = std::max(0.0, aa > 0 ? ar / aa : 0), onlyB = std::max(0.0, bb > 0 ? br / bb : 0);
    const double ofA = misfitOf(onlyA, 0), ofB = misfitOf(0, onlyB);
    return ofA < ofB ? FittedParts{onlyA, 0, ofA} : FittedParts{0, onlyB, ofB};
}

}  // namespace

void MeshFit::fit() {
    std::vector<MeshRun> known;
    std::copy_if(runs_.begin(), runs_.end(), std::back_inserter(known),
                 [](const MeshRun& run) { return isUsableRun(run) && !run.isAccident; });
    model_.reset();
    const auto differ = [&](auto member) {
        return std::any_of(known.begin(), known.end(),
                           [&](const MeshRun& run) { return run.*member != known.front().*member; });
    };
    if (known.size() < 3 || !differ(&MeshRun::cells) || !differ(&MeshRun::steps)) return;
    constexpr std::size_t most = 6;  // the nearest to where it is looked for, which are the last
    if (known.size() > most) known.erase(known.begin(), known.end() - most);
    Model bestModel;
    std::vector<double> a(known.size()), b(known.size()), signs(known.size());
    for (const double p : {orderInTime_ + 0.0, orderInTime_ + 2.0, orderInTime_ + 4.0})
        for (const double q : {orderInSpace_ - 1.0, orderInSpace_ - 0.5, orderInSpace_ + 0.0})
            for (const double sign : {1.0, -1.0}) {
                // Which part is the larger one is not known where they have different signs.
                const unsigned patterns = sign > 0 ? 1U : 1U << known.size();
                for (unsigned pattern = 0; pattern < patterns; ++pattern) {
                    for (std::size_t i = 0; i < known.size(); ++i) {
                        a[i] = std::pow(known[i].steps, -p) / known[i].error;
                        b[i] = sign * std::pow(static_cast<double>(known[i].cells), -q) / known[i].error;
                        signs[i] = pattern >> i & 1U ? -1 : 1;
                    }
                    const FittedParts parts = fittedParts(a, b, signs);
                    // Of two explanations the usual one: equal signs, and the claimed orders.
                    const double unlikely =
                        (sign > 0 ? 1 : 4) * (1 + 0.2 * (p - orderInTime_)) * (1 + 0.4 * (orderInSpace_ - q));
                    const double misfit = (parts.misfit + 1e-6) * unlikely;
                    if (misfit < bestModel.misfit) bestModel = {parts.A, parts.B, p, q, sign, misfit};
                }
            }
    if (std::isfinite(bestModel.misfit)) model_ = bestModel;
    // Costs, of the first pairs that differ in one of the two.
    for (const MeshRun& x : known)
        for (const MeshRun& y : known) {
            if (!(x.cost > 0 && y.cost > 0)) continue;
            if (x.cells == y.cells && y.steps >= 1.5 * x.steps)
                bySteps_ = std::clamp(std::log(y.cost / x.cost) / std::log(y.steps / x.steps), 0.5, 1.1);
            if (x.steps == y.steps && y.cells >= 1.5 * x.cells)
                byCells_ = std::clamp(
                    std::log(y.cost / x.cost) / std::log(static_cast<double>(y.cells) / x.cells), 0.5, 1.3);
        }
}

/// From the nearest run.
double MeshFit::costAt(double cells, double steps) const {
    const MeshRun* near = nullptr;
    double least = HUGE_VAL;
    for (const MeshRun& run : runs_) {
        const double away = std::abs(std::log(run.steps / steps)) +
                            std::abs(std::log(static_cast<double>(run.cells) / cells));
        if (isUsableRun(run) && run.cost > 0 && away < least) least = away, near = &run;
    }
    if (!near) return 0;
    return near->cost * std::pow(cells / static_cast<double>(near->cells), byCells_) *
           std::pow(steps / near->steps, bySteps_);
}

/// A run with steps at least as long on a mesh at least as fine has failed: it was not stable, or its
/// equations had no solution.
bool MeshFit::isTooCoarse(double cells, double steps) const {
    constexpr double slack = 1.05;
    return std::any_of(runs_.begin(), runs_.end(), [&](const MeshRun& run) {
        return !isUsableRun(run) && !run.isCutOff &&
               steps / cells < slack * run.steps / static_cast<double>(run.cells);
    });
}

bool MeshFit::isNew(int cells, double steps) const {
    constexpr double same = 1.03;
    return std::none_of(runs_.begin(), runs_.end(), [&](const MeshRun& run) {
        const double nearN = std::max(run.cells / static_cast<double>(cells),
                                      static_cast<double>(cells) / run.cells),
                     nearSteps = std::max(run.steps / steps, steps / run.steps);
        return nearN < same && nearSteps < same;
    });
}

/// Over meshes in small ratios, each with the fewest steps that should do; also with a few more, so that
/// parts which happen to cancel do not count.
std::optional<MeshPair> MeshFit::cheapest(double wanted, double most) const {
    constexpr double ratio = 1.0905077326652577;  // 2^(1/8)
    const double aim = aimedAt * wanted;
    std::optional<MeshPair> best;
    for (double N = least_; N <= mostCells; N *= ratio) {
        const int cells = static_cast<int>(std::lround(N));
        for (double n = 1; n <= mostTimeSteps; n = std::max(n + 1, std::round(n * ratio))) {
            const double cost = costAt(cells, n);
            if (cost > most || (best && cost >= best->cost)) break;
            if (isTooCoarse(cells, n) || !isNew(cells, n)) continue;
            if (model_->errorAt(cells, n) > aim || model_->errorAt(cells, 1.1 * n) > aim) continue;
            best = MeshPair{cells, n, cost};
            break;
        }
    }
    return best;
}

/// Before anything is known of both parts: two lengths of steps and two meshes. Where the wish is reached
/// already, both are made coarser.
std::optional<MeshPair> MeshFit::first(double wanted, double most) const {
    constexpr std::ptrdiff_t mostFailures = 5;
    if (std::count_if(runs_.begin(), runs_.end(), [](const MeshRun& r) { return !isUsableRun(r); }) >
        mostFailures)
        return {};
    double n = steps_, longest = 0, shortest = HUGE_VAL, failed = 0;
    bool isOtherMesh = false;
    for (const MeshRun& run : runs_) {
        if (!isUsableRun(run)) {
            if (run.isCutOff) return {};
            n = std::max(n, 2 * run.steps);
            failed = std::max(failed, run.steps);
            continue;
        }
        longest = std::max(longest, run.steps);
        shortest = std::min(shortest, run.steps);
        isOtherMesh = isOtherMesh || run.cells != cells_;
    }
    const bool haveLengths = longest >= 1.2 * shortest;
    int cells = cells_;
    if (const MeshRun* const found = best(wanted)) {
        cells = found->cells;
        n = found->steps;
        if (!isOtherMesh && cells >= 2 * least_)
            cells /= 2;
        else if (const double fewer = failed > 0 ? std::sqrt(failed * n) : n / 2; !haveLengths)
            n = std::max(1.0, std::round(fewer));
        else
            return {};
    } else if (longest > 0) {
        n = std::max(n, haveLengths ? longest : 2 * longest);
        if (haveLengths) cells = 2 * cells_;
    }
    const double cost = costAt(cells, n);
    if (cost > most || !isNew(cells, n)) return {};
    return MeshPair{cells, n, cost};
}

std::optional<MeshPair> MeshFit::next(double wanted, double most) const {
    if (runs_.size() >= mostPairs) return {};
    const MeshRun* const found = best(wanted);
    most = std::min(most, found ? worthwhile * found->cost : HUGE_VAL);
    return model_ ? cheapest(wanted, most) : first(wanted, most);
}

}  // namespace extremal
