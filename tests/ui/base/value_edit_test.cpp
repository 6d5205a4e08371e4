// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/base/value_edit.hpp"

#include <QComboBox>
#include <QLineEdit>
#include <QSignalSpy>
#include <QSpinBox>
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
    /// A count that may be left out is no number until one is given, and none again.
    void aCountThatIsLeftOutIsShownAsSuch() {
        FieldInfo info = integerField("cells", "N", 2, 100, nullptr, "");
        info.isOptional = true;
        ValueEdit edit(info);
        edit.show(Value());
        auto* const spin = edit.findChild<QSpinBox*>();
        QCOMPARE(spin->text(), QStringLiteral("default"));
        QSignalSpy edited(&edit, &ValueEdit::edited);
        spin->stepUp();
        QCOMPARE(edited[0][0].value<Value>().asNumber(), 2.0);
        spin->stepDown();
        QVERIFY(edited[1][0].value<Value>().isNull());
        edit.show(Value(7.0));
        QCOMPARE(spin->text(), QStringLiteral("7"));
        info.isOptional = false;
        QCOMPARE(ValueEdit(info).findChild<QSpinBox*>()->minimum(), 2);
    }
    void aChoiceThatIsLeftOutIsShownAsSuch() {
        FieldInfo info = choiceField("first", "first", {"kick", "drift"}, "");
        info.fallback = nullptr;
        info.isOptional = true;
        ValueEdit edit(info);
        edit.show(Value());
        auto* const box = edit.findChild<QComboBox*>();
        QCOMPARE(box->currentText(), QStringLiteral("default"));
        QSignalSpy edited(&edit, &ValueEdit::edited);
        edit.show(Value("drift"));
        QCOMPARE(box->currentText(), QStringLiteral("drift"));
        QVERIFY(edited.isEmpty());
        emit box->activated(1);
        QCOMPARE(edited[0][0].value<Value>().asString(), std::string("kick"));
        emit box->activated(0);
        QVERIFY(edited[1][0].value<Value>().isNull());
        info.isOptional = false;
        QCOMPARE(ValueEdit(info).findChild<QComboBox*>()->count(), 2);
    }
    void aNumberThatIsLeftOutIsShownAsSuch() {
        FieldInfo info = numberField("mass", "mass term", "", 0, "");
        info.fallback = nullptr;
        info.isOptional = true;
        ValueEdit edit(info);
        edit.show(Value());
        auto* const text = edit.findChild<QLineEdit*>();
        QCOMPARE(text->placeholderText(), QStringLiteral("default"));
        QVERIFY(text->text().isEmpty());
        QSignalSpy edited(&edit, &ValueEdit::edited);
        text->setText("0.5");
        emit text->editingFinished();
        QCOMPARE(edited[0][0].value<Value>().asNumber(), 0.5);
        text->setText("");
        emit text->editingFinished();
        QVERIFY(edited[1][0].value<Value>().isNull());
    }
};

EXTREMAL_TEST(ValueEditTest)

}  // namespace extremal::value_edit_test

#include "value_edit_test.moc"
