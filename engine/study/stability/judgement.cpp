// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/stability/judgement.hpp"

#include <algorithm>
#include <cmath>

namespace extremal {
namespace {

constexpr Judgement allJudgements[] = {Judgement::right,    Judgement::coarse,   Judgement::wrong,
                                       Judgement::lost,     Judgement::diverged, Judgement::refused,
                                       Judgement::notJudged};

Judgement ofFailure(Outcome cause) {
    switch (cause) {
        case Outcome::refused:
            return Judgement::refused;
        case Outcome::lost:
        case Outcome::underResolved:
            return Judgement::lost;
        case Outcome::stopped:
        case Outcome::stepBudget:
            return Judgement::unknown;
        default:
            return Judgement::diverged;
    }
}

}  // namespace

std::string_view name(Judgement judgement) {
    switch (judgement) {
        case Judgement::right:
            return "right";
        case Judgement::coarse:
            return "coarse";
        case Judgement::wrong:
            return "wrong";
        case Judgement::lost:
            return "lost";
        case Judgement::diverged:
            return "diverged";
        case Judgement::refused:
            return "refused";
        case Judgement::notJudged:
            return "not judged";
        case Judgement::unknown:
            break;
    }
    return "";
}

Judgement judgementOf(std::string_view text) {
    for (const Judgement each : allJudgements)
        if (name(each) == text) return each;
    return Judgement::unknown;
}

Judgement judge(RunStatus status, Outcome cause, std::span<const JudgedValue> values) {
    constexpr double likeTheMotion = 0.2;
    if (status == RunStatus::failed) return ofFailure(cause);
    if (status != RunStatus::done) return Judgement::unknown;
    const auto isHidden = [](const JudgedValue& v) {
        return std::isnan(v.value) || (v.floor > v.wish && v.value <= v.floor);
    };
    if (values.empty() || std::any_of(values.begin(), values.end(), isHidden)) return Judgement::notJudged;
    const auto isMet = [](const JudgedValue& v) { return v.value <= v.wish; };
    const auto isSmall = [](const JudgedValue& v) {
        return v.value <= v.wish || v.value < likeTheMotion * v.size;
    };
    if (std::all_of(values.begin(), values.end(), isMet)) return Judgement::right;
    return std::all_of(values.begin(), values.end(), isSmall) ? Judgement::coarse : Judgement::wrong;
}

}  // namespace extremal
