// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/text/formula_text.hpp"

#include <QHash>
#include <QTextBlock>
#include <QTextCursor>
#include <QTextDocument>
#include <QVector>

#include "engine/passport/formula_parts.hpp"

namespace extremal {
namespace {

// Characters for private use, which no text contains: they open and close what has a format.
enum Mark : char16_t { italic = 0xE000, raised, lowered, root, closed };

const QHash<QString, QString>& symbols() {
    static const QHash<QString, QString> all{{"alpha", "α"},
                                             {"beta", "β"},
                                             {"gamma", "γ"},
                                             {"delta", "δ"},
                                             {"epsilon", "ϵ"},
                                             {"varepsilon", "ε"},
                                             {"theta", "θ"},
                                             {"lambda", "λ"},
                                             {"mu", "μ"},
                                             {"nu", "ν"},
                                             {"xi", "ξ"},
                                             {"pi", "π"},
                                             {"rho", "ρ"},
                                             {"sigma", "σ"},
                                             {"tau", "τ"},
                                             {"phi", "φ"},
                                             {"varphi", "φ"},
                                             {"psi", "ψ"},
                                             {"omega", "ω"},
                                             {"Delta", "Δ"},
                                             {"Omega", "Ω"},
                                             {"Psi", "Ψ"},
                                             {"hbar", "ħ"},
                                             {"cdot", "·"},
                                             {"times", "×"},
                                             {"le", "≤"},
                                             {"ge", "≥"},
                                             {"approx", "≈"},
                                             {"pm", "±"},
                                             {"infty", "∞"},
                                             {"partial", "∂"},
                                             {"nabla", "∇"},
                                             {"int", "∫"},
                                             {"sum", "Σ"},
                                             {"to", "→"},
                                             {"ll", "≪"},
                                             {"gg", "≫"},
                                             {"sin", "sin"},
                                             {"cos", "cos"},
                                             {"tan", "tan"},
                                             {"exp", "exp"},
                                             {"log", "log"},
                                             {",", QString(QChar(0x2009))},
                                             {";", " "},
                                             {" ", " "},
                                             {"quad", "  "}};
    return all;
}

/// Reads a formula from left to right.
class Tex {
public:
    explicit Tex(const QString& text) : text_(text) {}
    QString all() {
        QString out;
        while (at_ < text_.size()) out += atom();
        return out;
    }

private:
    QString atom() {
        const QChar c = text_[at_++];
        if (c == '\\') return command();
        if (c == '{') return group();
        if (c == '^') return QChar(raised) + argument() + QChar(closed);
        if (c == '_') return QChar(lowered) + argument() + QChar(closed);
        if (c == '-') return QString(QChar(0x2212));
        if (c == '\'') return QString(QChar(0x2032));
        if (c == '*') return QString(QChar(0x00B7));
        if (c.isLetter()) return QChar(italic) + QString(c) + QChar(closed);
        return c;
    }
    QString command() {
        qsizetype end = at_;
        while (end < text_.size() && text_[end].isLetter()) ++end;
        if (end == at_ && end < text_.size()) ++end;
        const QString name = text_.mid(at_, end - at_);
        at_ = end;
        // A space that only ends the name.
        if (at_ + 1 < text_.size() && text_[at_] == ' ' && text_[at_ + 1].isLetter()) ++at_;
        if (name == "sqrt") return QStringLiteral("√") + QChar(root) + argument() + QChar(closed);
        if (name == "frac") {
            const QString above = argument(), below = argument();
            return above + "/" + below;
        }
        const auto known = symbols().constFind(name);
        if (known == symbols().constEnd()) return "\\" + name;
        // Functions are set apart from what follows.
        const bool isFunction = known->size() == 3 && known->at(0).isLower() && known->at(0).unicode() < 128;
        return isFunction ? *known + QChar(0x2009) : *known;
    }
    /// Deeper than any formula of use; beyond it braces are characters, as the stack is not without end.
    static constexpr int mostLevels = 64;

    QString argument() {
        if (at_ >= text_.size()) return {};
        if (levels_ >= mostLevels) return text_[at_++];
        ++levels_;
        const QString out = atom();
        --levels_;
        return out;
    }
    QString group() {
        if (levels_ >= mostLevels) return QStringLiteral("{");
        ++levels_;
        QString out;
        while (at_ < text_.size() && text_[at_] != '}') out += atom();
        ++at_;
        --levels_;
        return out;
    }

    const QString& text_;
    qsizetype at_ = 0;
    int levels_ = 0;
};

}  // namespace

QString withFormulas(const QString& text) {
    QString out;
    qsizetype from = 0;
    while (from < text.size()) {
        const qsizetype open = text.indexOf('$', from), close = open < 0 ? -1 : text.indexOf('$', open + 1);
        if (close < 0) break;
        // A dollar sign before a space, or one after a space, does not belong to a formula.
        if (close == open + 1 || text[open + 1].isSpace() || text[close - 1].isSpace()) {
            out += text.mid(from, close - from);
            from = close;
            continue;
        }
        out += text.mid(from, open - from) + Tex(text.mid(open + 1, close - open - 1)).all();
        from = close + 1;
    }
    return out + text.mid(from);
}

void formatFormulas(QTextDocument& document) {
    // One change: outside of an edit block each cursor looks for its line in the whole paragraph.
    QTextCursor whole(&document);
    whole.beginEditBlock();
    for (QTextBlock block = document.begin(); block.isValid(); block = block.next()) {
        QVector<std::pair<int, char16_t>> open;  // positions in the block, and what begins there
        const QString text = block.text();       // read once: notes can be one long paragraph
        int at = 0;                              // in the block, of which the marks so far are gone
        for (const QChar character : text) {
            const char16_t c = character.unicode();
            if (c < italic || c > closed) {
                ++at;
                continue;
            }
            QTextCursor cursor(block);
            cursor.setPosition(block.position() + at);
            cursor.setPosition(block.position() + at + 1, QTextCursor::KeepAnchor);
            cursor.removeSelectedText();  // deleteChar would look for the next letter in the whole paragraph
            if (c != closed) {
                open.push_back({at, c});
                continue;
            }
            if (open.isEmpty()) continue;
            const auto [begin, kind] = open.takeLast();
            QTextCharFormat format;
            if (kind == italic) format.setFontItalic(true);
            if (kind == raised) format.setVerticalAlignment(QTextCharFormat::AlignSuperScript);
            if (kind == lowered) format.setVerticalAlignment(QTextCharFormat::AlignSubScript);
            if (kind == root) format.setFontOverline(true);
            cursor.setPosition(block.position() + begin);
            cursor.setPosition(block.position() + at, QTextCursor::KeepAnchor);
            cursor.mergeCharFormat(format);
        }
    }
    whole.endEditBlock();
}

void formatPage(QTextDocument& document) {
    for (QTextBlock block = document.begin(); block.isValid(); block = block.next()) {
        const QTextBlockFormat shape = block.blockFormat();
        if (shape.hasProperty(QTextFormat::BlockCodeFence)) continue;  // a listing
        const bool isFormula = shape.hasProperty(QTextFormat::BlockCodeLanguage);
        const QString text = block.text();
        const std::vector<FormulaPart> parts = formulaParts(text.toStdString(), isFormula);
        if (isFormula) {
            QTextCursor all(block);
            all.movePosition(QTextCursor::EndOfBlock, QTextCursor::KeepAnchor);
            QTextCharFormat body;
            body.setFont(document.defaultFont());
            all.setCharFormat(body);
        }
        // From the end, so that the places before stay what they are.
        int end = static_cast<int>(text.size());
        for (auto part = parts.rbegin(); part != parts.rend(); ++part) {
            const QString set = QString::fromStdString(part->text);
            const bool isPlain = part->script == Script::none;
            // Its marks, "_{}", are characters of one byte.
            const int marks = static_cast<int>(part->length - part->text.size());
            const int begin = end - static_cast<int>(set.size()) - marks;
            if (!isPlain || part->isVariable) {
                QTextCursor cursor(block);
                cursor.setPosition(block.position() + begin);
                cursor.setPosition(block.position() + end, QTextCursor::KeepAnchor);
                QTextCharFormat format = cursor.charFormat();
                if (part->isVariable) format.setFontItalic(true);
                if (!isPlain)
                    format.setVerticalAlignment(part->script == Script::lowered
                                                    ? QTextCharFormat::AlignSubScript
                                                    : QTextCharFormat::AlignSuperScript);
                cursor.insertText(set, format);
            }
            end = begin;
        }
    }
}

}  // namespace extremal
