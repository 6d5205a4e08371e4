// SPDX-License-Identifier: GPL-3.0-or-later
/// A run makes the products that its views need, and no others.
#include <QTest>

#include <algorithm>

#include "engine/run/files/export.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::products_test {
namespace {

Scene sceneOf(const std::string& model, const std::string& scheme, const Value::Array& views) {
    const std::string text =
        R"({"extremal": 1, "time": {"end": 0.5}, "observe": ["energy", "error"], "model": )" + model +
        R"(, "schemes": [{"label": "s", "step": 0.05, "scheme": )" + "\"" + scheme + "\"}]}";
    return readScene(text, {{"/views", views}}).scene;
}

bool hasAny(const ViewEntry& entry, std::initializer_list<Product> products) {
    return std::any_of(products.begin(), products.end(), [&](Product p) {
        return std::find(entry.products.begin(), entry.products.end(), p) != entry.products.end();
    });
}

}  // namespace

class ProductsTest : public QObject {
    Q_OBJECT
private slots:
    void aViewAloneMakesWhatItNeeds_data() {
        QTest::addColumn<QString>("model");
        QTest::addColumn<QString>("scheme");
        QTest::newRow("coordinates") << R"({"type": "pendulum"})"
                                     << "galerkin-gauss-2";
        QTest::newRow("body") << R"({"type": "rigid-body", "inertia": [1, 2, 3]})"
                              << "lie-2";
        QTest::newRow("wave") << R"({"type": "schrodinger", "modes": 16})"
                              << "schrodinger-gauss-1";
    }
    void aViewAloneMakesWhatItNeeds() {
        QFETCH(QString, model);
        QFETCH(QString, scheme);
        int seen = 0;
        for (const ViewEntry& entry : viewEntries()) {
            Value view = entry.item.id;
            if (entry.item.id == mapView)
                view = Value::Object{{"view", entry.item.id},
                                     {"cells", Value::Array{2, 2}},
                                     {"steps", Value::Array{0.05, 0.1}},
                                     {"duration", 0.2}};
            const Scene scene = sceneOf(model.toStdString(), scheme.toStdString(), {view});
            if (scene.schemes.empty()) QFAIL("the scene is wrong");
            const System system = makeSystem(scene);
            if (!missingFor({entry.item.id, "", ""}, system).empty() || scene.views.empty()) continue;
            ++seen;
            const Comparison c = run(scene);
            const Products& made = c.schemes.at(0)->products;
            const auto is = [&](bool isMade, std::initializer_list<Product> needed) {
                return isMade == hasAny(entry, needed);
            };
            const bool hasState = !stateColumns(system).empty();
            const std::string& id = entry.item.id;
            QVERIFY2(!hasState || is(made.find<DenseOutput>(), {Product::denseOutput, Product::denseError}),
                     id.c_str());
            QVERIFY2(made.find<DenseOutput>() == nullptr ||
                         is(made.find<DenseOutput>()->points.find("error"), {Product::denseError}),
                     id.c_str());
            // The export of a wave function is made of its frames.
            QCOMPARE(made.find<FieldFrames>() != nullptr, static_cast<bool>(system.field));
            QVERIFY2(is(made.find<Sections>(), {Product::sections}), id.c_str());
            QVERIFY2(is(made.find<MovedRings>(), {Product::rings}), id.c_str());
            QVERIFY2(is(made.find<KktPattern>(), {Product::kktPattern}), id.c_str());
            QVERIFY2(is(made.find<ActionDefect>(), {Product::actionDefect}), id.c_str());
            QVERIFY2(is(c.products.find<ParameterMaps>(), {Product::parameterMap}), id.c_str());
        }
        QVERIFY(seen > 8);
    }
    void nothingIsMadeForNoView() {
        const Scene scene = sceneOf(R"({"type": "pendulum"})", "midpoint", {Value("energy"), Value("step")});
        const Comparison c = run(scene);
        QCOMPARE(c.schemes.at(0)->products.size() + c.products.size(), std::size_t(0));
        // What is shown besides the views of the scene can be asked for.
        const Comparison more = run(scene, {.products = {Product::denseOutput}});
        QVERIFY(more.schemes.at(0)->products.find<DenseOutput>());
    }
    void everyProductOfTheExportHasItsSuffix() {
        const Scene scene =
            sceneOf(R"({"type": "pendulum"})", "galerkin-gauss-2",
                    {Value("section"), Value("sparsity"), Value("discrete-lagrangian"), Value("phase")});
        const Value files = *summaryValue(run(scene)).find("files");
        std::string names;
        for (const Value& file : files.asArray()) names += file.asString() + " ";
        QCOMPARE(names,
                 std::string("scene.json s.csv s.section.csv s.kkt.csv s.action-defect.csv summary.csv "
                             "summary.json "));
    }
};

EXTREMAL_TEST(ProductsTest)
}  // namespace extremal::products_test

#include "products_test.moc"
