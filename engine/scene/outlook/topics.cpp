// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/scene/outlook/topics.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "engine/family/family.hpp"
#include "engine/model/system.hpp"
#include "engine/scene/read/pointer.hpp"

namespace extremal {
namespace {

constexpr std::pair<const char*, const char*> findingTopics[] = {
    {"body-step", "rigid-bodies#orders"},
    {"duration", "command-line#long-runs"},
    {"equidistribution", "moving-meshes#where-it-fails-and-the-fallback"},
    {"error-bars", "structure#error-bars-without-a-reference"},
    {"few-nodes", "quadratures#how-many-nodes"},
    {"field-step", "fields#the-schemes"},
    {"local-errors", "structure#where-the-error-is-made"},
    {"mechanisms", "mechanisms#keys"},
    {"monitors", "phase-space#steps-that-follow-a-monitor"},
    {"momentum", "structure#which-schemes-keep-a-momentum"},
    {"order-conditions", "own-tables#what-is-found-from-the-coefficients"},
    {"refused", "schemes#discretizations-that-are-refused-or-lose-order"},
    {"resonance", "multiscale#resonances"},
    {"rule-per-term", "own-space#a-rule-for-each-term"},
    {"solvability", "moving-times#where-there-is-no-solution"},
    {"stability-limit", "quadratures#how-large-a-step-may-be"},
    {"step-density", "moving-times#what-the-steps-are"},
    {"strangers", "security"},
    {"tangent-map", "structure#the-tangent-map-of-a-step"},
    {"sensitivity", "structure#derivatives-by-numbers"},
    {"three-levels", "waves#three-levels"},
    {"way-back", "structure#there-and-back"},
};

constexpr std::pair<Outcome, const char*> outcomeTopics[] = {
    {Outcome::diverged, "schemes#when-a-run-ends-early"},
    {Outcome::singular, "schemes#when-a-run-ends-early"},
    {Outcome::energyUnsolvable, "moving-times#where-there-is-no-solution"},
    {Outcome::notFinite, "schemes#when-a-run-ends-early"},
    {Outcome::stepBudget, "schemes#when-a-run-ends-early"},
    {Outcome::lost, "studies#runs-that-are-lost"},
    {Outcome::underResolved, "waves#collapse"},
    {Outcome::refused, "schemes#when-a-run-ends-early"},
    {Outcome::stopped, "schemes#when-a-run-ends-early"},
};

/// Parts of a scene, the longest first of those that begin alike. A star is any index.
constexpr std::pair<std::string_view, const char*> partTopics[] = {
    {"/schemes/*/space", "spaces"},
    {"/schemes/*/quadrature", "quadratures"},
    {"/schemes/*/baseline", "baselines"},
    {"/schemes/*/scheme", "schemes"},
    {"/schemes/*/composition", "schemes#compositions"},
    {"/schemes/*/monitor", "phase-space#steps-that-follow-a-monitor"},
    {"/schemes", "scenes#schemes"},
    {"/model/constraints", "mechanisms#keys"},
    {"/model/forces", "mechanisms#keys"},
    {"/model/dissipation", "mechanisms#keys"},
    {"/model/hamiltonian", "phase-space#keys"},
    {"/model", "models"},
    {"/initial", "scenes#initial"},
    {"/time", "scenes#time-and-rows"},
    {"/output", "scenes#time-and-rows"},
    {"/reference", "scenes#reference"},
    {"/events", "scenes#events"},
    {"/views", "scenes#views"},
    {"/observe", "observables#observables"},
    {"/steps", "scenes#lessons"},
    {"", "scenes#top-level"},
};

/// "/schemes/12/space/degree" -> "/schemes/*/space/degree".
std::string withStars(std::string_view pointer) {
    std::string text;
    while (!pointer.empty()) {
        const auto end = std::min(pointer.find('/', 1), pointer.size());
        const std::string_view key = pointer.substr(1, end - 1);
        const bool isIndex =
            !key.empty() && std::all_of(key.begin(), key.end(), [](char c) { return c >= '0' && c <= '9'; });
        text.append("/").append(isIndex ? "*" : key);
        pointer.remove_prefix(end);
    }
    return text;
}

bool isBelow(std::string_view pointer, std::string_view part) {
    return pointer.starts_with(part) && (pointer.size() == part.size() || pointer[part.size()] == '/');
}

const Topic* findTopic(std::string_view id) {
    const auto found =
        std::find_if(topics().begin(), topics().end(), [&](const Topic& t) { return t.id == id; });
    return found == topics().end() ? nullptr : &*found;
}

}  // namespace

const std::vector<Topic>& topics() {
    static const std::vector<Topic> all = [] {
        std::vector<Topic> list;
        for (const auto& [id, place] : findingTopics) list.push_back({id, place});
        for (const auto& [outcome, place] : outcomeTopics)
            list.push_back({"outcome." + std::string(name(outcome)), place});
        for (const auto& [part, place] : partTopics) list.push_back({"scene." + std::string(part), place});
        for (const ModelEntry& model : modelCatalog())
            list.push_back({"model." + model.item.id, "models#" + model.item.id});
        for (const CatalogItem& space : spaceCatalog())
            list.push_back({"space." + space.id, "spaces#" + space.id});
        return list;
    }();
    return all;
}

void nameTopics(std::vector<Problem>& problems, const Value& document) {
    constexpr std::string_view model = "/model", space = "/schemes/*/space";
    for (Problem& p : problems) {
        if (!p.topic.empty()) continue;
        const std::string pointer = withStars(p.pointer);
        const bool isOfModel = isBelow(pointer, model);
        if (!isOfModel && !isBelow(pointer, space)) continue;
        const std::string below = pointer.substr((isOfModel ? model : space).size());
        const Value* const part = valueAt(document, p.pointer.substr(0, p.pointer.size() - below.size()));
        const Value* const type = part && part->isObject() ? part->find("type") : part;
        if (!type || !type->isString()) continue;
        const std::string id = (isOfModel ? "model." : "space.") + type->asString();
        if (findTopic(id)) p.topic = id;
    }
}

std::string handbookPlace(const Problem& problem) {
    if (const Topic* topic = findTopic(problem.topic)) return topic->place;
    const std::string pointer = withStars(problem.pointer);
    return std::find_if(std::begin(partTopics), std::end(partTopics),
                        [&](const auto& part) { return isBelow(pointer, part.first); })
        ->second;
}

std::string handbookPlace(Outcome outcome) {
    for (const auto& [end, place] : outcomeTopics)
        if (end == outcome) return place;
    return {};
}

}  // namespace extremal
