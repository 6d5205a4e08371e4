// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/kinds.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <exception>
#include <sstream>
#include <thread>

#include "engine/core/text/expression.hpp"
#include "engine/run/reference/reference_file.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/fuzz/mutation.hpp"

namespace extremal::fuzz {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

const std::vector<Value>& documents() {
    static const std::vector<Value> all = [] {
        std::vector<Value> trees;
        for (const Preset& preset : presets()) {
            trees.push_back(parseJson(preset.json));
            // Of a plane with 65536 modes a fuzzed scene would spend half the time.
            Value* const model = trees.back().find("model");
            for (const char* modes : {"modes", "modes_y"})
                if (Value* const many = model->find(modes); many && many->isNumber() && many->asNumber() > 64)
                    *many = 64.0;
        }
        return trees;
    }();
    return all;
}

std::string faultOf(const std::vector<Problem>& problems, bool hasOverrides = false) {
    for (const Problem& p : problems) {
        if (p.message.empty()) return "a finding at \"" + p.pointer + "\" without a message";
        if (!hasOverrides && !p.pointer.empty() && p.pointer.front() != '/')
            return "\"" + p.pointer + "\" is not a place of a scene";
    }
    return {};
}

/// A short run from the start of the scene, stopped on the way.
std::string runShortly(const ResolvedScene& scene) {
    Run run(scene, {.threads = 1});
    run.start();
    const auto begin = Clock::now();
    while (!run.isFinished() && Clock::now() - begin < 2ms) std::this_thread::sleep_for(50us);
    const std::clock_t asked = std::clock();
    run.stop();
    run.wait();
    const double taken = static_cast<double>(std::clock() - asked) / CLOCKS_PER_SEC;
    return taken > 3 ? "works for " + std::to_string(taken) + " s after it was asked to stop" : "";
}

std::string judgeRead(const ReadScene& read, bool hasOverrides = false) {
    if (std::string fault = faultOf(read.errors, hasOverrides); !fault.empty()) return fault;
    if (std::string fault = faultOf(read.warnings, hasOverrides); !fault.empty()) return fault;
    if (!read.errors.empty()) return {};
    const std::string written = writeScene(read.scene);
    const ReadScene again = readScene(written);
    if (!again.errors.empty())
        return "is refused after it was written: " + again.errors[0].pointer + ": " + again.errors[0].message;
    if (writeScene(again.scene) != written) return "is another scene after it was written";
    try {
        return runShortly(*read.resolved);
    } catch (const InvalidScene& e) {
        return std::string("is valid and cannot be run: ") + e.what();
    }
}

std::size_t schemesOf(const Value& document) {
    const Value* const schemes = document.find("schemes");
    return schemes && schemes->isArray() ? schemes->asArray().size() : 0;
}

/// The scene with one of its schemes, which is checked and run in a fraction of the time.
Value withScheme(Value document, std::size_t which) {
    Value* const schemes = document.find("schemes");
    *schemes = Value::Array{Value(schemes->asArray()[which])};
    return document;
}

/// Most scenes have one of the schemes of their preset; one in eight has all.
constexpr std::size_t manySchemes = 8;

std::string makeScene(Random& random) {
    const Value& document = random.of(documents());
    const bool isWhole = random.oneIn(manySchemes);
    return writeJson(mutated(isWhole ? document : withScheme(document, random.below(schemesOf(document))),
                             random.of(documents()), random));
}

std::string makeBytes(Random& random) { return mutated(random.of(presets()).json, random); }

std::string judgeText(const std::string& text) { return judgeRead(readScene(text)); }

/// The name of a preset, or "NAME/2" for that scene with its third scheme alone, and an override on each
/// further line.
std::string makeSet(Random& random) {
    const std::size_t preset = random.below(presets().size());
    std::string text(presets()[preset].id);
    if (!random.oneIn(manySchemes))
        text += "/" + std::to_string(random.below(schemesOf(documents()[preset])));
    for (std::size_t n = 1 + random.below(3); n > 0; --n) {
        const std::string value = random.oneIn(2) ? writeCompactJson(hostileValue(random))
                                                  : formula(random, {"k", "m", "l", "x", "pi"}, 2);
        std::string line = somePointer(documents()[preset], random) + "=" + value;
        if (random.oneIn(10)) line = mutated(line, random);
        std::replace(line.begin(), line.end(), '\n', ' ');
        text += "\n" + line;
    }
    return text;
}

std::string judgeSet(const std::string& text) {
    std::istringstream lines(text);
    std::string id;
    std::getline(lines, id);
    const std::size_t slash = id.find('/');
    const Preset* const preset = findPreset(id.substr(0, slash));
    if (!preset) return "no such preset";
    Value document = documents()[static_cast<std::size_t>(preset - presets().data())];
    if (slash != std::string::npos)
        document = withScheme(std::move(document), std::stoul(id.substr(slash + 1)));
    std::vector<Override> overrides;
    for (std::string line; std::getline(lines, line);) {
        try {
            overrides.push_back(parseOverride(line));
        } catch (const InvalidScene& e) {
            if (e.problems().front().message.empty()) return "an override is refused without a message";
        }
    }
    return judgeRead(readScene(document, overrides), true);
}

std::string makeExpression(Random& random) {
    const std::vector<std::string> names = {"x", "y", "x_t", "y_t", "t", "k", "dot(x)"};
    std::string text =
        "k*x_t^2/2 + y_t^2/2 - " + formula(random, names, 1 + static_cast<int>(random.below(6)));
    if (random.oneIn(3)) text = formula(random, names, 4);
    return random.oneIn(4) ? mutated(text, random) : text;
}

std::string judgeExpression(const std::string& text) {
    try {
        const Expression parsed = parseExpression(text);
        evaluate(parsed, [](std::string_view) { return 0.7; });
        const std::vector<std::string> names = parsed.names();
        const std::string renamed = withNameReplaced(text, "x", "abc");
        if (parseExpression(renamed).nodes.size() != parsed.nodes.size())
            return "changes its form when renamed";
    } catch (const ExpressionError& e) {
        if (e.position > text.size()) return "an error behind the end of the text";
        if (caretLines(text, e.position).empty()) return "an error that cannot be shown";
    }
    Value model{Value::Object{}};
    model.set("type", "lagrangian");
    model.set("coordinates", Value::Array{"x", "y"});
    model.set("parameters", Value::Object{{"k", Value(2)}});
    model.set("lagrangian", text);
    Value scene{Value::Object{}};
    scene.set("extremal", 1);
    scene.set("model", std::move(model));
    scene.set("initial", Value::Object{{"q", Value::Array{0.3, -0.4}}, {"v", Value::Array{0.1, 0.2}}});
    scene.set("time", Value::Object{{"end", Value(1)}});
    Value scheme{Value::Object{}};
    scheme.set("step", 0.1);
    scheme.set("space", Value::Object{{"type", "polynomial"}, {"degree", Value(2)}});
    scene.set("schemes", Value::Array{std::move(scheme)});
    return judgeRead(readScene(scene));
}

std::string makeReferenceText(Random& random) {
    std::string text = "t,q.theta,p.theta,energy\n";
    for (std::size_t rows = random.below(20), i = 0; i < rows; ++i) {
        text += std::to_string(0.1 * static_cast<double>(i));
        for (int k = 0; k < 3; ++k)
            text +=
                random.oneIn(30) ? "," : "," + std::to_string(static_cast<double>(random.below(1000)) / 500);
        text += '\n';
    }
    return random.oneIn(5) ? text : mutated(text, random);
}

std::string judgeReference(const std::string& text) {
    static const ReadScene pendulum = readScene(findPreset("pendulum")->json);
    std::istringstream in(text);
    try {
        const Reference reference = readReference(in, "reference.csv", *pendulum.resolved->system);
        const ExactSolution solution = reference.make();
        std::vector<double> x(2);
        for (const double t : {0.0, 0.1, -1e300, 1e300}) solution(t, x);
        return {};
    } catch (const InvalidScene& e) {
        return faultOf(e.problems());
    }
}

}  // namespace

const std::vector<Kind>& kinds() {
    static const std::vector<Kind> all = {{"scene", makeScene, judgeText},
                                          {"bytes", makeBytes, judgeText},
                                          {"set", makeSet, judgeSet},
                                          {"expression", makeExpression, judgeExpression},
                                          {"reference", makeReferenceText, judgeReference}};
    return all;
}

std::string makeCase(const Kind& kind, std::uint64_t seed, std::uint64_t number) {
    Random random(seed, number);
    return kind.make(random);
}

std::string judgeCase(const Kind& kind, const std::string& text) {
    try {
        return kind.judge(text);
    } catch (const std::exception& e) {
        return std::string("an exception came out: ") + e.what();
    }
}

}  // namespace extremal::fuzz
