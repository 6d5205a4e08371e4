// SPDX-License-Identifier: GPL-3.0-or-later
/// Spins on a ring, a chain or any graph, with the energy of a bond and that of a site typed: Heisenberg's
/// magnets, precession in a field, Landau-Lifshitz equations without damping.
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/core/text/expression.hpp"
#include "engine/model/spins/spin_system.hpp"
#include "engine/model/typed/phase/typed_variables.hpp"

namespace extremal::systems {
namespace {

constexpr int mostSpins = 500;

int spinAt(const Value& given, const std::string& pointer, int count) {
    const double number = given.isNumber() ? given.asNumber() : 0;
    if (!(number >= 1 && number <= count) || number != static_cast<int>(number))
        throw InvalidScene(pointer, "is not the number of a spin",
                           "a number from 1 to " + std::to_string(count));
    return static_cast<int>(number) - 1;
}

std::vector<SpinModel::Bond> bondsOf(const Value& given, int count) {
    std::vector<SpinModel::Bond> bonds;
    const bool isRing = given.isString() && given.asString() == "ring";
    if (isRing && count < 3)
        throw InvalidScene("/bonds", "is a ring of " + std::to_string(count),
                           "\"chain\", or 3 spins or more");
    if (isRing || (given.isString() && given.asString() == "chain")) {
        for (int i = 0; i + 1 < count; ++i) bonds.push_back({i, i + 1, 1});
        if (isRing) bonds.push_back({count - 1, 0, 1});
        return bonds;
    }
    if (!given.isArray())
        throw InvalidScene("/bonds", "must be \"ring\", \"chain\" or a list of pairs",
                           "[[1, 2], [2, 3]], say");
    for (std::size_t k = 0; k < given.asArray().size(); ++k) {
        const Value& each = given.asArray()[k];
        const std::string pointer = "/bonds/" + std::to_string(k);
        if (!each.isArray() || each.asArray().size() != 2)
            throw InvalidScene(pointer, "must be a pair of spins", "[1, 2], say");
        const int i = spinAt(each.asArray()[0], pointer + "/0", count),
                  j = spinAt(each.asArray()[1], pointer + "/1", count);
        if (i == j) throw InvalidScene(pointer, "joins a spin to itself", "a term of \"site\"");
        bonds.push_back({i, j, 1});
    }
    return bonds;
}

/// Null where the key is left out.
std::shared_ptr<const typed::TypedFunction> functionOf(const Settings& settings, const char* key,
                                                       const std::vector<std::string>& variables) {
    const Value* const text = settings.find(key);
    if (!text || text->isNull() || (text->isString() && text->asString().empty())) return nullptr;
    const auto parameters = typed::parametersOf(settings);
    for (const auto& [name, value] : parameters)
        if (std::find(variables.begin(), variables.end(), name) != variables.end())
            throw InvalidScene("/parameters/" + name, "the name \"" + name + "\" has a meaning already",
                               "another name");
    return std::make_shared<const typed::TypedFunction>(text->asString(), std::string("/") + key, variables,
                                                        parameters);
}

SpinModel modelOfSpins(const Settings& settings) {
    SpinModel model;
    const int count = settings.integer("count");
    const Value* const weights = settings.find("weights");
    if (!weights || weights->isNull()) {
        model.weights.assign(static_cast<std::size_t>(count), 1);
    } else {
        model.weights = extremal::spins::weightsOf(*weights, "/weights");
        if (model.count() != count)
            throw InvalidScene("/weights", "has " + std::to_string(model.count()) + " numbers",
                               std::to_string(count) + ", one for each spin");
    }
    model.pair = functionOf(settings, "pair", {"a1", "a2", "a3", "b1", "b2", "b3"});
    model.site = functionOf(settings, "site", {"s1", "s2", "s3"});
    if (!model.pair && !model.site) throw InvalidScene("", "has no energy", "\"pair\" or \"site\", or both");
    if (model.pair) model.bonds = bondsOf(*settings.find("bonds"), count);
    return model;
}

std::vector<FieldInfo> spinFields() {
    FieldInfo count = integerField("count", "N", 1, mostSpins, 8, "How many spins there are.");
    count.title = "spins";
    FieldInfo bonds = jsonField("bonds", "bonds", "", "ring",
                                "\"ring\", \"chain\", or a list of pairs of spins, counted from 1.");
    FieldInfo pair = textField("pair", "", "", "Energy of a bond in its two spins a1..a3 and b1..b3.");
    pair.title = "energy of a bond";
    pair.example = "-J*(a1*b1 + a2*b2 + a3*b3)";
    FieldInfo site = textField("site", "", "", "Energy of each spin s1..s3 by itself.");
    site.title = "energy of a site";
    FieldInfo weights = optionalJsonField(
        "weights", "weights", "One number for each spin, its angular momentum; 1 where left out.");
    return {count, bonds, pair, site, parametersField({{"J", 1}}), weights};
}

}  // namespace

ModelEntry spins() {
    ModelEntry e;
    e.item = {"spins",
              "spins",
              "Spins of length 1 that precess in a field, which other spins make: rings, chains, graphs.",
              spinFields(),
              {},
              ""};
    e.initial = {extremal::spins::startField("spins")};
    e.exampleEnd = 20;
    e.exampleStep = 0.1;
    e.make = [](const Settings& settings) {
        return extremal::spins::systemOf("spins", modelOfSpins(settings),
                                         extremal::spins::SpinPicture::arrows);
    };
    e.checkInitial = [](const Settings& settings, const System& system, const State& initial) {
        const Value* const pair = settings.find("pair");
        extremal::spins::checkFinite(system, initial, pair && !pair->isNull() ? "/pair" : "/site");
    };
    return e;
}

}  // namespace extremal::systems
