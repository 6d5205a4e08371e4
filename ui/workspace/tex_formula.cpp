// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/workspace/tex_formula.hpp"

#include <QHash>
#include <QSet>

#include <algorithm>
#include <utility>

#include "engine/core/text/expression.hpp"

namespace extremal {
namespace {

/// Functions by their commands, and letters that have another name here.
const QHash<QString, QString>& functions() {
    static const QHash<QString, QString> all{
        {"sin", "sin"},   {"cos", "cos"},     {"tan", "tan"},       {"sinh", "sinh"},
        {"cosh", "cosh"}, {"tanh", "tanh"},   {"exp", "exp"},       {"ln", "log"},
        {"log", "log"},   {"arcsin", "asin"}, {"arccos", "acos"},   {"arctan", "atan"},
        {"max", "max"},   {"min", "min"},     {"operatorname", ""}, {"mathrm", ""}};
    return all;
}
const QHash<QString, QString>& letters() {
    static const QHash<QString, QString> all{
        {"vartheta", "theta"}, {"varphi", "phi"}, {"varepsilon", "epsilon"}, {"varrho", "rho"}, {"ell", "l"},
        {"hbar", "hbar"},      {"pi", "pi"}};
    return all;
}
/// Spaces, and commands that change nothing but the look.
bool isNothing(const QString& command) {
    static const QSet<QString> all{
        ",",        ";",    ":",      "!",    " ",    "quad", "qquad",        "left",
        "right",    "big",  "Big",    "bigl", "bigr", "Bigl", "Bigr",         "limits",
        "bigg",     "Bigg", "rm",     "it",   "[",    "]",    "displaystyle", "textstyle",
        "nonumber", "\\",   "mathcal"};
    return all.contains(command);
}
bool setsWords(const QString& command) {
    return command == "mathrm" || command == "text" || command == "mathit" || command == "operatorname" ||
           command == "textrm" || command == "mathsf";
}

/// Reads TeX from left to right and writes products with their signs.
class TexReader {
public:
    explicit TexReader(QString text) : text_(std::move(text)) {}

    /// Up to the end, or to what closes a group.
    QString sum(const QString& closing = {}) {
        QString out;
        bool needsTimes = false;  // what was written last is a factor
        while (!isAt(closing)) {
            const Part part = next();
            if (part.text.isEmpty()) continue;
            if (part.kind == Part::sign) {
                const bool isTight = part.text == "*" || part.text == "/" || part.text == ",";
                out += isTight || out.isEmpty() ? part.text : " " + part.text + " ";
                needsTimes = false;
                continue;
            }
            if (needsTimes) out += '*';
            out += part.text;
            needsTimes = true;
        }
        at_ += closing.size();
        return out.trimmed();
    }

private:
    struct Part {
        enum Kind { number, letter, velocity, function, bracket, sign } kind = sign;
        QString text = {};
    };

    bool isAtEnd() const { return at_ >= text_.size(); }
    bool isAt(const QString& closing) {
        skipSpace();
        return isAtEnd() || (!closing.isEmpty() && QStringView(text_).mid(at_).startsWith(closing));
    }
    void skipSpace() {
        while (!isAtEnd() &&
               (text_[at_].isSpace() || text_[at_] == '$' || text_[at_] == '&' || text_[at_] == '~'))
            ++at_;
    }
    QString command() {
        qsizetype end = ++at_;
        while (end < text_.size() && text_[end].isLetter() && text_[end].unicode() < 128) ++end;
        if (end == at_ && end < text_.size()) ++end;
        const QString name = text_.mid(at_, end - at_);
        at_ = end;
        return name;
    }
    /// What is in braces, or one token.
    QString argument() {
        skipSpace();
        if (isAtEnd()) return {};
        if (text_[at_] == '{') {
            ++at_;
            return sum("}");
        }
        if (text_[at_].isDigit()) return text_[at_++];  // \frac12
        return next(false).text;
    }
    /// In brackets where it is more than one factor.
    static QString bracketed(const QString& text) {
        const bool isWord = std::all_of(text.begin(), text.end(),
                                        [](QChar c) { return c.isLetterOrNumber() || c == '_' || c == '.'; });
        return isWord && !text.isEmpty() ? text : "(" + text + ")";
    }
    /// The word in braces, as it is.
    QString word() {
        skipSpace();
        if (isAtEnd() || text_[at_] != '{') return {};
        const qsizetype end = text_.indexOf('}', at_);
        const QString inside = end < 0 ? text_.mid(at_ + 1) : text_.mid(at_ + 1, end - at_ - 1);
        at_ = end < 0 ? text_.size() : end + 1;
        QString plain;
        for (const QChar c : inside)
            if (c.isLetterOrNumber() || c == '_') plain += c;
        return plain;
    }
    /// The name with an index below it, if one follows.
    QString withIndex(const QString& name) {
        skipSpace();
        if (isAtEnd() || text_[at_] != '_') return name;
        ++at_;
        QString index = argument();
        index.removeIf([](QChar c) { return !c.isLetterOrNumber(); });
        const bool isNumber = !index.isEmpty() && index.at(0).isDigit();
        return name + (isNumber || index == "t" ? "" : "_") + index;
    }
    Part withPower(Part part) {
        skipSpace();
        if (isAtEnd() || text_[at_] != '^') return part;
        ++at_;
        part.text += "^" + bracketed(argument());
        return part;
    }

    /// Of what is nested deeper than anybody writes the rest is left out.
    Part next(bool takesPower = true) {
        if (levels_ == mostLevels) at_ = text_.size();
        ++levels_;
        Part part = partAt(takesPower);
        --levels_;
        return part;
    }
    Part partAt(bool takesPower) {
        skipSpace();
        if (isAtEnd()) return {};
        const QChar c = text_[at_];
        const auto whole = [&](const Part& part) { return takesPower ? withPower(part) : part; };
        if (c == '\\') return ofCommand(takesPower);
        if (c.isDigit() || c == '.') {
            const qsizetype from = at_;
            while (!isAtEnd() && (text_[at_].isDigit() || text_[at_] == '.')) ++at_;
            return whole({Part::number, text_.mid(from, at_ - from)});
        }
        ++at_;
        if (c == 'e' && takesPower) return exponential();
        if (c.isLetter()) return whole({Part::letter, withIndex(c)});
        if (c == '(' || c == '[' || c == '{') {
            const QString inside = sum(c == '(' ? ")" : c == '[' ? "]" : "}");
            return whole({Part::bracket, "(" + inside + ")"});
        }
        if (c == '|') return whole({Part::bracket, "abs(" + sum("|") + ")"});
        if (c == '}') return {};
        if (c == QChar(0x2212)) return {Part::sign, "-"};
        return {Part::sign, c};
    }

    /// e to the power of a number is a letter, that of anything else the function.
    Part exponential() {
        const QString name = withIndex("e");
        skipSpace();
        if (name != "e" || isAtEnd() || text_[at_] != '^') return withPower({Part::letter, name});
        ++at_;
        const QString power = argument();
        bool isNumber = false;
        power.toDouble(&isNumber);
        if (isNumber) return {Part::letter, "e^" + bracketed(power)};
        return {Part::function, "exp(" + power + ")"};
    }

    Part ofCommand(bool takesPower) {
        const QString name = command();
        const auto whole = [&](const Part& part) { return takesPower ? withPower(part) : part; };
        if (name == "frac" || name == "dfrac" || name == "tfrac") {
            const QString above = argument(), below = argument();
            const QString text = bracketed(above) + "/" + bracketed(below);
            skipSpace();
            const bool isRaised = !isAtEnd() && text_[at_] == '^';
            return whole({Part::bracket, isRaised ? "(" + text + ")" : text});
        }
        if (name == "dot") return whole({Part::velocity, withIndex(argument()) + "_t"});
        if (name == "sqrt") {
            skipSpace();
            if (isAtEnd() || text_[at_] != '[') return whole({Part::function, "sqrt(" + argument() + ")"});
            ++at_;
            const QString root = sum("]");
            return whole({Part::function, "(" + argument() + ")^(1/" + bracketed(root) + ")"});
        }
        if (name == "cdot" || name == "times") return {Part::sign, "*"};
        if (name == "begin" || name == "end") {
            word();
            return {};
        }
        if (name == "lvert" || name == "vert") return whole({Part::bracket, "abs(" + sum("\\rvert") + ")"});
        if (setsWords(name)) {
            const QString plain = word();
            if (functions().contains(plain) && !functions().value(plain).isEmpty())
                return function(functions().value(plain));
            return whole({Part::letter, withIndex(plain)});
        }
        if (functions().contains(name)) return function(functions().value(name));
        if (isNothing(name)) return {};
        return whole({Part::letter, withIndex(letters().value(name, name))});
    }

    /// \sin^2\theta, \sin(x), \sin 2\theta
    Part function(const QString& name) {
        skipSpace();
        QString power, argument;
        if (!isAtEnd() && text_[at_] == '^') {
            ++at_;
            power = "^" + bracketed(this->argument());
        }
        while (true) {
            const qsizetype before = at_;
            const Part part = next();
            if (part.text.isEmpty() && at_ > before) continue;  // a space, \left
            const bool isFirst = argument.isEmpty();
            const bool isPart = part.kind == Part::number || part.kind == Part::letter;
            if (isFirst && !part.text.isEmpty() && part.kind != Part::sign) {
                const bool isBracket = part.kind == Part::bracket && part.text.startsWith('(') &&
                                       part.text.endsWith(')') && isClosedAtEnd(part.text);
                argument = isBracket ? part.text.mid(1, part.text.size() - 2) : part.text;
                if (!isPart) break;
                continue;
            }
            if (!isPart || part.text.isEmpty()) {
                at_ = before;
                break;
            }
            argument += "*" + part.text;
        }
        return {Part::function, name + "(" + argument + ")" + power};
    }
    /// Whether the first bracket is closed by the last one.
    static bool isClosedAtEnd(const QString& text) {
        int depth = 0;
        for (qsizetype i = 0; i < text.size(); ++i) {
            depth += text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0;
            if (depth == 0) return i + 1 == text.size();
        }
        return false;
    }

    static constexpr int mostLevels = 64;
    QString text_;
    qsizetype at_ = 0;
    int levels_ = 0;
};

}  // namespace

bool isTex(const QString& text) { return text.contains('\\') || text.contains('{'); }

QString formulaFromTex(const QString& text) {
    if (text.size() > static_cast<qsizetype>(maxExpressionLength)) return text;  // refused in any case
    QString body = text.mid(text.indexOf('=') + 1).trimmed();
    while (body.endsWith('.') || body.endsWith(',') || body.endsWith(';')) body.chop(1);
    return TexReader(body).sum();
}

}  // namespace extremal
