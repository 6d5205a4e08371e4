// SPDX-License-Identifier: GPL-3.0-or-later
/// A sample of a field as initial data: the scene that starts with it has the state that was sampled. Over
/// all models of the presets.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/scene/bind.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::sampled_start_test {
namespace {

std::vector<double> sampleOf(const System& system, const std::vector<double>& x) {
    std::vector<double> values(system.field.size());
    system.field.sample(x.data(), values.data());
    return values;
}

/// A state that no start of the scene has: other values, and rates where there were none.
std::vector<double> moved(const System& system, std::vector<double> x) {
    const std::size_t n = x.size() / 2;
    for (std::size_t i = 0; i < n; ++i) {
        // On a line not the same from left to right as from right to left; smooth around a period.
        x[i] *=
            0.9 +
            (system.field.y.empty()
                 ? 0.05 * std::sin(1 + 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n))
                 : 0.0);
        if (!system.field.isHeld || !system.field.isHeld(i)) x[n + i] = 0.8 * x[n + i] + 0.3 * x[i];
    }
    return x;
}

}  // namespace

class SampledStartTest : public QObject {
    Q_OBJECT
private slots:
    void theSceneStartsWithTheSample() {
        std::vector<std::string> models;
        for (const Preset& preset : presets()) {
            const Value document = parseJson(preset.json);
            const ReadScene read = readScene(document);
            const System system = makeSystem(read.scene);
            if (!system.field.initial) continue;
            if (std::count(models.begin(), models.end(), system.id) > 2) continue;
            models.push_back(system.id);
            const State start = initialState(read.scene, system);
            const std::vector<double> sample = sampleOf(system, moved(system, start.x));
            Value other = document;
            other.set("initial", system.field.initial(sample));
            const ReadScene again = readScene(other);
            const std::string name(preset.id);
            QVERIFY2(again.errors.empty(),
                     (name + ": " +
                      (again.errors.empty() ? "" : again.errors[0].pointer + " " + again.errors[0].message))
                         .c_str());
            const std::vector<double> found =
                sampleOf(system, initialState(again.scene, makeSystem(again.scene)).x);
            double size = 0, apart = 0;
            for (std::size_t i = 0; i < sample.size(); ++i) {
                size = std::max(size, std::abs(sample[i]));
                apart = std::max(apart, std::abs(sample[i] - found[i]));
            }
            QVERIFY2(size > 0 && apart <= 1e-13 * size,
                     (name + ": " + std::to_string(apart) + " of " + std::to_string(size)).c_str());
        }
        for (const char* model :
             {"field", "field-2d", "elastic-bar", "membrane", "schrodinger", "schrodinger-2d"})
            QVERIFY2(std::count(models.begin(), models.end(), model) > 0, model);
    }
    void aSampleThatIsTooShortIsRefused() {
        for (const char* key : {"displacement", "velocity"}) {
            const ReadScene read = readScene(
                std::string(
                    R"({"extremal":1,"model":{"type":"membrane"},"time":{"end":1},"schemes":[{"space":{"type":"asynchronous"}}]})"),
                std::vector<Override>{parseOverride(std::string("/initial={\"") + key + "\":[1,2,3]}")});
            QVERIFY(std::any_of(read.errors.begin(), read.errors.end(), [&](const Problem& p) {
                return p.pointer == std::string("/initial/") + key &&
                       p.message.find("one per node, got 3") != std::string::npos;
            }));
        }
    }
};

EXTREMAL_TEST(SampledStartTest)

}  // namespace extremal::sampled_start_test

#include "sampled_start_test.moc"
