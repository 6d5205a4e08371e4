// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/base/value_edit.hpp"

#include <QLineEdit>
#include <QSignalSpy>
#include <QTest>

#include <memory>

#include "tests/tools/test.hpp"

namespace extremal::value_edit_test {
namespace {

FieldInfo number() {
    FieldInfo info;
    info.key = "k";
    info.title = "stiffness";
    info.type = FieldType::number;
    return info;
}

std::unique_ptr<ValueEdit> typedInto(const QString& text) {
    auto edit = std::make_unique<ValueEdit>(number());
    edit->show(Value(1.0));
    edit->QWidget::show();
    edit->activateWindow();
    if (!QTest::qWaitForWindowActive(edit.get())) return nullptr;
    edit->setFocus();
    edit->findChild<QLineEdit*>()->selectAll();
    QTest::keyClicks(edit->findChild<QLineEdit*>(), text);
    return edit;
}

}  // namespace

class ValueEditTest : public QObject {
    Q_OBJECT
private slots:
    void returnSubmitsWhatIsTyped() {
        const auto edit = typedInto("2.5");
        QVERIFY(edit && edit->hasFocus());
        QSignalSpy edited(edit.get(), &ValueEdit::edited);
        QTest::keyClick(edit->findChild<QLineEdit*>(), Qt::Key_Return);
        QCOMPARE(edited.count(), 1);
        QCOMPARE(edited[0][0].value<Value>().asNumber(), 2.5);
    }
    void anInputThatIsRemovedWhileOneTypesSubmitsNothing() {
        auto edit = typedInto("2.5");
        QVERIFY(edit && edit->hasFocus());
        int submitted = 0;
        connect(edit.get(), &ValueEdit::edited, this, [&] { ++submitted; });
        edit.reset();
        QCOMPARE(submitted, 0);
    }
};

EXTREMAL_TEST(ValueEditTest)

}  // namespace extremal::value_edit_test

#include "value_edit_test.moc"
