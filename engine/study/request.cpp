// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/request.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string_view>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/study/search/reductions.hpp"
#include "engine/study/usable_value.hpp"

namespace extremal {
namespace {

/// "2/4".
Shard parseShard(const std::string& text) {
    if (text.empty()) return {};
    const std::size_t slash = text.find('/');
    const auto index = slash == std::string::npos ? std::nullopt : parseNumber(text.substr(0, slash)),
               count = slash == std::string::npos ? std::nullopt : parseNumber(text.substr(slash + 1));
    if (!index || !count || *index != std::floor(*index) || *count != std::floor(*count) || *count > 1e6 ||
        *index < 1 || *index > *count)
        throw InvalidScene("--shard", "must be I/N with I from 1 to N, got \"" + text + "\"",
                           "for example 1/4");
    return {static_cast<int>(*index), static_cast<int>(*count)};
}

/// "error.theta=1e-3". The number alone for a rung of a ladder, whose metric is said by --metric.
Wish parseWish(const std::string& text, bool isRung) {
    if (const auto number = parseNumber(text); isRung && number) return {"", *number};
    const std::size_t equals = text.rfind('=');
    const auto value = equals == std::string::npos ? std::nullopt : parseNumber(text.substr(equals + 1));
    if (!value || equals == 0)
        throw InvalidScene("--wish", "must be METRIC=VALUE, got \"" + text + "\"",
                           "for example error.theta=1e-3");
    return {text.substr(0, equals), *value};
}

/// A wish for the metric of the study.
double usableError(const StudyRequest& study) {
    requireUsable(study.error, "--error", "for example 1e-6");
    return study.error;
}

/// "2000", "64kB", "10MB", "1.5GB".
double parseBytes(const std::string& text, const std::string& option) {
    std::string number = text;
    double unit = 1;
    for (const auto& [name, bytes] : {std::pair{"kB", 1e3}, {"MB", 1e6}, {"GB", 1e9}, {"B", 1.0}}) {
        if (!number.ends_with(name)) continue;
        number.resize(number.size() - std::string(name).size());
        unit = bytes;
        break;
    }
    const auto value = parseNumber(number);
    if (!value || !(*value > 0) || !std::isfinite(*value))
        throw InvalidScene(option, "must be a positive number of bytes, got \"" + text + "\"",
                           "for example 64kB, 10MB, 1GB");
    return unit * *value;
}

/// "1", "1s", "500ms", "20us"; in seconds.
double parseSeconds(const std::string& text, const std::string& option) {
    std::string number = text;
    double unit = 1;
    if (number.ends_with("us")) {
        unit = 1e-6;
        number.resize(number.size() - 2);
    } else if (number.ends_with("ms")) {
        unit = 1e-3;
        number.resize(number.size() - 2);
    } else if (number.ends_with("s")) {
        number.resize(number.size() - 1);
    }
    const auto seconds = parseNumber(number);
    if (!seconds || !(std::isfinite(*seconds) && *seconds > 0))
        throw InvalidScene(option, "must be a time above 0, got \"" + text + "\"", "for example 500ms or 2s");
    return *seconds * unit;
}

void refuseStrangers(const StudyEntry& entry, const StudyRequest& study) {
    using Over = StudyEntry::Over;
    // Options of several studies.
    const bool isChanged = entry.over == Over::extremes && !study.x.empty(),
               hasWishes = entry.over == Over::wishes || entry.over == Over::usableSteps || isChanged;
    const auto refuse = [&](bool isGiven, Over over, std::string_view option, const char* whose) {
        bool isOwn = entry.over == over;
        if (option == "--wish" || option == "--error") isOwn = isOwn || hasWishes;
        if (option == "--candidates" || option == "--memory") isOwn = isOwn || entry.over == Over::wishes;
        if (option == "--search-time")
            isOwn = isOwn || entry.over == Over::wishes || entry.over == Over::usableSteps;
        if (option == "--over" || option == "--of" || option == "--knobs")
            isOwn = isOwn || entry.over == Over::wishes;
        if (option == "--knobs") isOwn = isOwn || entry.over == Over::steps;
        if (option == "--x" || option == "--y") isOwn = isOwn || isChanged;
        if (isGiven && !isOwn)
            throw InvalidScene(std::string(option), "is not an option of " + entry.item.id,
                               std::string(whose) + " has it");
    };
    refuse(study.error != 0, Over::wantedError, "--error", "cheapest");
    refuse(!study.wishes.empty(), Over::wantedError, "--wish", "cheapest");
    refuse(!study.budget.empty(), Over::wantedError, "--budget", "cheapest");
    refuse(!study.memory.empty(), Over::wantedError, "--memory", "cheapest");
    refuse(!study.candidates.empty(), Over::wantedError, "--candidates", "cheapest");
    refuse(!study.searchTime.empty(), Over::wantedError, "--search-time", "cheapest");
    refuse(!study.knobs.empty(), Over::wantedError, "--knobs", "cheapest");
    refuse(!study.over.empty(), Over::wantedError, "--over", "cheapest");
    refuse(!study.of.empty(), Over::wantedError, "--of", "cheapest");
    refuse(!study.x.empty(), Over::numbers, "--x", "stability");
    refuse(!study.y.empty(), Over::numbers, "--y", "stability");
    refuse(study.findsLimits, Over::numbers, "--limit", "stability");
    refuse(study.isLong, Over::extremes, "--long", "extremes");
    for (const auto& [isGiven, option] : {std::pair{!study.steps.empty(), "--steps"},
                                          {study.from != 0, "--from"},
                                          {study.to != 0, "--to"},
                                          {study.points != 0, "--points"}})
        refuse(isGiven, Over::steps, option, "convergence");
    const StudyRequest usual;
    if (entry.over != Over::wantedError && !hasWishes)
        for (const auto& [isGiven, option] : {std::pair{study.metric != usual.metric, "--metric"},
                                              {study.isFinal, "--final"},
                                              {study.repeat != usual.repeat, "--repeat"}})
            refuse(isGiven, Over::steps, option, "convergence");
    if (entry.over == Over::usableSteps || isChanged)
        refuse(study.repeat != usual.repeat, Over::steps, "--repeat", "convergence");
    refuse(isChanged && study.isLong, Over::steps, "--long", "extremes without a scene");
    if (entry.over == Over::extremes && !isChanged && !study.only.empty())
        throw InvalidScene("--only", "is not an option of " + entry.item.id, "convergence has it");
    if (!study.steps.empty() && (study.from != 0 || study.to != 0))
        throw InvalidScene("--steps", "says what --from and --to say as well", "one or the other");
    if (entry.over == Over::wantedError && study.error == 0 && study.wishes.empty() && study.budget.empty())
        throw InvalidScene("--error", "is required for " + entry.item.id,
                           "for example --error 1e-6, --wish energy=1e-6, or --budget 1ms");
    if (!study.candidates.empty() && study.candidates != "scene" && study.candidates != "all")
        throw InvalidScene("--candidates", "must be scene or all, got \"" + study.candidates + "\"");
    if (entry.over == Over::numbers && study.x.empty())
        throw InvalidScene("--x", "is required for " + entry.item.id,
                           "for example '/schemes/*/step=0.01:1:50:log'");
}

/// Of a study over given steps.
void checkKnobs(const ResolvedScene& scene, const StudyRequest& study, const SearchKnobs& knobs) {
    if (knobs.isDegree)
        throw InvalidScene("--knobs", "has degree, which is not a knob of " + study.kind,
                           "step,cells or step");
    if (std::none_of(scene.schemes.begin(), scene.schemes.end(),
                     [&](const ResolvedScheme& scheme) { return cellsOf(scheme, scene) > 0; }))
        throw InvalidScene("--knobs", "is for schemes on a mesh that may be refined, and the scene has none",
                           "without --knobs");
}

Sweep sweepOf(const ResolvedScene& scene, const StudyRequest& study, bool isLadder, unsigned threads) {
    SweepOptions options;
    options.wantedError = isLadder ? 0 : study.error;
    options.metric = study.metric;
    if (isLadder && study.error != 0) options.wishes.push_back({"", usableError(study)});
    for (const std::string& wish : study.wishes) options.wishes.push_back(parseWish(wish, isLadder));
    for (const Wish& wish : options.wishes)
        if (isLadder && !wish.metric.empty() && wish.metric != study.metric)
            throw InvalidScene("--wish",
                               "is of \"" + wish.metric + "\", and the ladder of \"" + study.metric + "\"",
                               "--metric " + wish.metric);
    if (!isLadder && study.error == 0 && !options.wishes.empty()) {  // the first wish stands in for --error
        options.metric = options.wishes.front().metric;
        options.wantedError = options.wishes.front().value;
        options.wishes.erase(options.wishes.begin());
        if (options.wantedError == 0)
            throw InvalidScene("--wish", "must be positive and finite, got 0", "for example 1e-6");
    }
    if (isLadder) {
        for (const Wish& wish : options.wishes) options.rungs.push_back(wish.value);
        std::sort(options.rungs.begin(), options.rungs.end(), std::greater<>());
        options.wishes.clear();
        if (options.rungs.empty()) options.rungs = usualRungs();
    }
    if (std::string budget = study.budget; !budget.empty()) {
        options.isPerTime = budget.ends_with("/s");
        if (options.isPerTime) budget.resize(budget.size() - 2);
        options.budget = parseSeconds(budget, "--budget");
        // Without a wish the metric is compared as it is.
        if (options.wantedError == 0) options.wantedError = 1;
    }
    if (!study.memory.empty()) options.mostBytes = parseBytes(study.memory, "--memory");
    options.hasAllCandidates = study.candidates == "all" || (isLadder && study.candidates.empty());
    if (!study.searchTime.empty()) options.searchSeconds = parseSeconds(study.searchTime, "--search-time");
    options.knobs = parseKnobs(study.knobs);
    if (!study.knobs.empty() && !isLadder && options.wantedError == 0)
        checkKnobs(scene, study, options.knobs);
    options.over = parseCases(study.over, study.of);
    options.isAtEnd = study.isFinal;
    options.ladder = {study.steps, study.from, study.to, study.points};
    if (study.steps.empty() && (study.from != 0 || study.to != 0) && study.points == 0)
        options.ladder.points = 12;
    if (study.points > 0 && study.from == 0 && study.to == 0)
        throw InvalidScene("--points", "needs --from and --to");
    options.repeat = study.repeat;
    options.only = study.only;
    options.shard = parseShard(study.shard);
    options.threads = threads;
    return {scene, options};
}

/// "METRIC=VALUE", all of which must hold; the metric alone is a wish of a thousandth of its size.
std::vector<Wish> wishesOf(const StudyRequest& study) {
    std::vector<Wish> all;
    if (study.error != 0) all.push_back({study.metric, usableError(study)});
    for (const std::string& text : study.wishes) {
        all.push_back(parseWish(text, false));
        requireUsable(all.back().value, "--wish", "for example error.theta=1e-3");
    }
    return all;
}

LimitsStudy limitsOf(const ResolvedScene& scene, const StudyRequest& study, unsigned threads) {
    LimitsOptions options;
    options.metric = study.metric;
    options.isAtEnd = study.isFinal;
    options.wishes = wishesOf(study);
    if (!study.searchTime.empty()) options.seconds = parseSeconds(study.searchTime, "--search-time");
    options.only = study.only;
    options.shard = parseShard(study.shard);
    options.threads = threads;
    return {scene, options};
}

ExtremesStudy extremesOf(const ResolvedScene& scene, const StudyRequest& study, unsigned threads) {
    ExtremesOptions options;
    options.x = parseAxis(study.x, "--x");
    if (!study.y.empty()) options.y = parseAxis(study.y, "--y");
    options.metric = study.metric;
    options.isAtEnd = study.isFinal;
    options.wishes = wishesOf(study);
    options.only = study.only;
    options.shard = parseShard(study.shard);
    options.threads = threads;
    return {scene, options};
}

StabilityStudy stabilityOf(const ResolvedScene& scene, const StudyRequest& study, unsigned threads) {
    StabilityOptions options;
    options.x = parseAxis(study.x, "--x");
    if (!study.y.empty()) options.y = parseAxis(study.y, "--y");
    options.findsLimits = study.findsLimits;
    options.only = study.only;
    options.shard = parseShard(study.shard);
    options.threads = threads;
    return {scene, options};
}

}  // namespace

const StudyEntry& knownStudy(const StudyRequest& request) {
    std::vector<std::string> names;
    for (const StudyEntry& e : studyEntries()) names.push_back(e.item.id);
    const StudyEntry* study = findStudy(request.kind);
    if (!study)
        throw InvalidScene("arguments", "there is no study \"" + request.kind + "\"",
                           suggestName(request.kind, names));
    refuseStrangers(*study, request);
    return *study;
}

AnyStudy makeStudy(const StudyEntry& entry, const StudyRequest& request, const ResolvedScene* scene,
                   unsigned threads) {
    if (entry.over == StudyEntry::Over::extremes && request.x.empty())
        return ExtremesStudy(parseShard(request.shard), threads, request.isLong);
    if (!scene) throw InvalidScene("arguments", "SCENE is required", "see extremal study --help");
    switch (entry.over) {
        case StudyEntry::Over::numbers:
            return stabilityOf(*scene, request, threads);
        case StudyEntry::Over::extremes:
            return extremesOf(*scene, request, threads);
        case StudyEntry::Over::usableSteps:
            return limitsOf(*scene, request, threads);
        case StudyEntry::Over::testEquation:
            return LinearStudy(*scene, {request.only, parseShard(request.shard), threads});
        default:
            return sweepOf(*scene, request, entry.over == StudyEntry::Over::wishes, threads);
    }
}

}  // namespace extremal
