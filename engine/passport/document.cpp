// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/passport/document.hpp"

#include <algorithm>
#include <string_view>

#include "engine/core/text/markup.hpp"
#include "engine/passport/formula_parts.hpp"
#include "engine/run/files/replacing.hpp"

namespace extremal {
namespace {

/// An index or exponent: letters, digits and signs as in a formula, and anything else as a text in it.
std::string scriptInLatex(const std::string& text) {
    static constexpr Replacement minus[] = {{"−", "-"}};
    const std::string plain = replaced(text, minus);
    constexpr std::string_view known =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789 +-*/=,.:()";
    return plain.find_first_not_of(known) == std::string::npos ? plain : "\\text{" + latexText(text) + "}";
}

/// "a_t^2" is set as in formulas.
std::string inLatex(std::string_view text) {
    std::string out;
    for (const FormulaPart& part : formulaParts(text, false)) {
        if (part.script == Script::none)
            out += latexText(part.text);
        else
            out += (part.script == Script::lowered ? "$_{" : "$^{") + scriptInLatex(part.text) + "}$";
    }
    return out;
}

/// Indices and exponents lowered and raised; in formulas variables are italic.
std::string inHtml(std::string_view text, bool isFormula = false) {
    std::string out;
    for (const FormulaPart& part : formulaParts(text, isFormula)) {
        std::string set = markupText(part.text);
        if (part.isVariable) set = "<i>" + set + "</i>";
        if (part.script == Script::lowered) set = "<sub>" + set + "</sub>";
        if (part.script == Script::raised) set = "<sup>" + set + "</sup>";
        out += set;
    }
    return out;
}

bool isEmpty(const std::vector<std::string>& cells) {
    return std::all_of(cells.begin(), cells.end(), [](const std::string& cell) { return cell.empty(); });
}

constexpr const char* style = R"(
:root { --text: #1f2328; --muted: #5d6672; --line: #d9dde2; --code: #f3f4f6; }
body { margin: 0; color: var(--text); font: 15px/1.55 Inter, "Segoe UI", "Helvetica Neue", Arial, sans-serif; }
main { max-width: 900px; margin: 0 auto; padding: 28px 20px 60px; }
h1 { font-size: 26px; margin: 0 0 4px; } h2 { font-size: 18px; margin: 26px 0 6px; }
p { margin: 8px 0; }
p.formula { margin: 6px 0 6px 24px; font-family: "STIX Two Math", Cambria, "Times New Roman", serif; font-size: 16px; }
pre { background: var(--code); padding: 10px 14px; border-radius: 6px; overflow-x: auto; font-size: 13px; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; margin: 8px 0; }
th, td { padding: 3px 12px 3px 0; text-align: left; border-bottom: 1px solid var(--line); }
th { font-weight: 600; color: var(--muted); font-size: 13px; }
)";

class Markdown {
public:
    static std::string begin(const std::string& title) { return "# " + markdownText(title) + "\n"; }
    static std::string end() { return {}; }
    std::string operator()(const Document::Heading& h) const { return "\n## " + markdownText(h.text) + "\n"; }
    std::string operator()(const Document::Paragraph& p) const { return "\n" + markdownText(p.text) + "\n"; }
    std::string operator()(const Document::Formulas& f) const {
        std::string text = "\n";
        for (const WrittenFormula& line : f.lines) text += "    " + visibleLine(line.plain) + "\n";
        return text;
    }
    std::string operator()(const Document::Table& t) const {
        std::string text = "\n";
        const auto row = [&](const std::vector<std::string>& cells) {
            text += "|";
            for (const std::string& cell : cells) text += " " + markdownText(cell) + " |";
            text += "\n";
        };
        row(t.columns);
        text += "|";
        for (std::size_t i = 0; i < t.columns.size(); ++i) text += " --- |";
        text += "\n";
        for (const auto& cells : t.rows) row(cells);
        return text;
    }
    std::string operator()(const Document::Listing& l) const { return "\n" + markdownListing(l.lines); }
};

class Html {
public:
    static std::string begin(const std::string& title) {
        return "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>" +
               markupText(title) + "</title>\n<style>" + style + "</style>\n</head>\n<body>\n<main>\n<h1>" +
               markupText(title) + "</h1>\n";
    }
    static std::string end() { return "</main>\n</body>\n</html>\n"; }
    std::string operator()(const Document::Heading& h) const { return "<h2>" + inHtml(h.text) + "</h2>\n"; }
    std::string operator()(const Document::Paragraph& p) const { return "<p>" + inHtml(p.text) + "</p>\n"; }
    std::string operator()(const Document::Formulas& f) const {
        std::string text;
        for (const WrittenFormula& line : f.lines)
            text += "<p class=\"formula\">" + inHtml(line.plain, true) + "</p>\n";
        return text;
    }
    std::string operator()(const Document::Table& t) const {
        std::string text = "<div class=\"wide\"><table>\n";
        const auto row = [&](const std::vector<std::string>& cells, const std::string& tag) {
            text += "<tr>";
            for (const std::string& cell : cells) text += "<" + tag + ">" + inHtml(cell) + "</" + tag + ">";
            text += "</tr>\n";
        };
        if (!isEmpty(t.columns)) row(t.columns, "th");
        for (const auto& cells : t.rows) row(cells, "td");
        return text + "</table></div>\n";
    }
    std::string operator()(const Document::Listing& l) const {
        std::string text = "<pre>";
        for (const std::string& line : l.lines) text += markupText(line) + "\n";
        return text + "</pre>\n";
    }
};

class Latex {
public:
    static std::string begin(const std::string& title) {
        return "\\documentclass[a4paper,10pt]{article}\n\\usepackage[T1]{fontenc}\n\\usepackage[utf8]{"
               "inputenc}\n"
               "\\usepackage{amsmath,amssymb,longtable}\n\\usepackage[margin=1.7cm]{geometry}\n"
               "\\setlength{\\parindent}{0pt}\n\\begin{document}\n\\section*{" +
               inLatex(title) + "}\n";
    }
    static std::string end() { return "\\end{document}\n"; }
    std::string operator()(const Document::Heading& h) const {
        return "\n\\subsection*{" + inLatex(h.text) + "}\n";
    }
    std::string operator()(const Document::Paragraph& p) const { return "\n" + inLatex(p.text) + "\n"; }
    std::string operator()(const Document::Formulas& f) const {
        std::string text = "\\begin{gather*}\n";
        for (std::size_t i = 0; i < f.lines.size(); ++i)
            text += f.lines[i].tex + (i + 1 < f.lines.size() ? " \\\\\n" : "\n");
        return text + "\\end{gather*}\n";
    }
    std::string operator()(const Document::Table& t) const {
        std::string text =
            "\n\\begin{longtable}[l]{@{}" + std::string(t.columns.size(), 'l') + "@{}}\n\\hline\n";
        const auto row = [&](const std::vector<std::string>& cells) {
            for (std::size_t i = 0; i < cells.size(); ++i) text += (i > 0 ? " & " : "") + inLatex(cells[i]);
            text += " \\\\\n";
        };
        if (!isEmpty(t.columns)) {
            row(t.columns);
            text += "\\hline\n";
        }
        for (const auto& cells : t.rows) row(cells);
        return text + "\\hline\n\\end{longtable}\n";
    }
    std::string operator()(const Document::Listing& l) const {
        return "\n{\\footnotesize\n" + latexListing(l.lines) + "}\n";
    }
};

template <class Writer>
std::string writtenBy(const Document& document) {
    std::string text = Writer::begin(document.title);
    for (const Document::Block& block : document.blocks) text += std::visit(Writer(), block);
    return text + Writer::end();
}

}  // namespace

std::string written(const Document& document, PageFormat format) {
    switch (format) {
        case PageFormat::html:
            return writtenBy<Html>(document);
        case PageFormat::latex:
            return writtenBy<Latex>(document);
        case PageFormat::markdown:
            break;
    }
    return writtenBy<Markdown>(document);
}

std::string writtenForFile(const Document& document, PageFormat format) {
    const std::string text = written(document, format);
    if (format == PageFormat::latex) return markedAsOwn(text, "% ");
    if (format == PageFormat::html) return markedAsOwn(text, "<!-- ", " -->", 1);  // behind the doctype
    return markedAsOwn(text, "<!-- ", " -->", static_cast<int>(std::count(text.begin(), text.end(), '\n')));
}

}  // namespace extremal
