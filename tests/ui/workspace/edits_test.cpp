// SPDX-License-Identifier: GPL-3.0-or-later
/// Edits of a scene as a tree: what they change, and that all else stays.
#include <QTest>

#include "engine/scene/read/json.hpp"
#include "tests/tools/test.hpp"
#include "ui/workspace/document.hpp"

namespace extremal::edits_test {
namespace {

Value tree(const char* text) { return parseJson(text); }

}  // namespace

class EditsTest : public QObject {
    Q_OBJECT
private slots:
    void anEditChangesItsPlaceAlone_data() {
        QTest::addColumn<QString>("pointer");
        QTest::addColumn<QString>("value");  // empty: it is removed
        QTest::addColumn<QString>("expected");
        const auto row = [](const char* name, const char* pointer, const char* value, const char* expected) {
            QTest::newRow(name) << QString(pointer) << QString(value) << QString(expected);
        };
        row("a value", "/b/1", "7", R"({"a":{"x":1},"b":[1,7,3]})");
        row("a member is made", "/a/y", "2", R"({"a":{"x":1,"y":2},"b":[1,2,3]})");
        row("with what is on the way", "/c/d", "2", R"({"a":{"x":1},"b":[1,2,3],"c":{"d":2}})");
        row("appended", "/b/-", "4", R"({"a":{"x":1},"b":[1,2,3,4]})");
        row("the whole", "", "5", "5");
        row("the first is removed", "/b/0", "", R"({"a":{"x":1},"b":[2,3]})");
        row("one in the middle", "/b/1", "", R"({"a":{"x":1},"b":[1,3]})");
        row("the last", "/b/2", "", R"({"a":{"x":1},"b":[1,2]})");
        row("a member", "/a/x", "", R"({"a":{},"b":[1,2,3]})");
        row("nothing is there to remove", "/b/3", "", R"({"a":{"x":1},"b":[1,2,3]})");
        row("nor there", "/c/d", "", R"({"a":{"x":1},"b":[1,2,3]})");
        row("beyond the end", "/b/3", "4", R"({"a":{"x":1},"b":[1,2,3]})");
        row("within a number", "/a/x/y", "4", R"({"a":{"x":1},"b":[1,2,3]})");
    }
    void anEditChangesItsPlaceAlone() {
        QFETCH(QString, pointer);
        QFETCH(QString, value);
        QFETCH(QString, expected);
        Edit edit{pointer.toStdString(), {}};
        if (!value.isEmpty()) edit.value = tree(qPrintable(value));
        QVERIFY(withEdits(tree(R"({"a":{"x":1},"b":[1,2,3]})"), {edit}) == tree(qPrintable(expected)));
    }
    void editsFollowEachOther() {
        const Value made =
            withEdits(tree(R"([1,2,3])"), {{"/0", std::nullopt}, {"/0", Value(5.0)}, {"/-", Value(6.0)}});
        QVERIFY(made == tree("[5,3,6]"));
    }
};

EXTREMAL_TEST(EditsTest)

}  // namespace extremal::edits_test

#include "edits_test.moc"
