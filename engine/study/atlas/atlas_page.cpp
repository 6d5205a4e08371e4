// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "engine/core/text/markup.hpp"
#include "engine/core/text/text.hpp"
#include "engine/study/atlas/atlas.hpp"

namespace extremal {
namespace {

using Verdict = AtlasRow::Verdict;

const char* const style = R"(
:root { --text: #1f2328; --muted: #5d6672; --line: #d9dde2; --panel: #ffffff; --ground: #f3f4f6; --accent: #0b62d6; }
* { box-sizing: border-box; }
body { margin: 0; background: var(--ground); color: var(--text);
  font: 14px/1.5 Inter, "Segoe UI", "Helvetica Neue", Arial, sans-serif; }
main { max-width: 1280px; margin: 0 auto; padding: 28px 20px 60px; }
h1 { font-size: 26px; margin: 0 0 4px; } h2 { font-size: 18px; margin: 0; }
p { margin: 6px 0; } .muted { color: var(--muted); }
nav { margin: 14px 0 22px; } nav a { margin-right: 14px; white-space: nowrap; }
a { color: var(--accent); text-decoration: none; } a:hover { text-decoration: underline; }
section { background: var(--panel); border: 1px solid var(--line); border-radius: 8px; padding: 16px 18px;
  margin: 0 0 18px; }
img { display: block; width: 100%; max-width: 820px; height: auto; margin: 10px 0; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { padding: 3px 10px; text-align: right; white-space: nowrap; border-bottom: 1px solid var(--line); }
th { font-weight: 600; color: var(--muted); font-size: 12.5px; vertical-align: bottom; }
th:first-child, td:first-child, td.text, th.text { text-align: left; }
td.below { color: #a3260b; font-weight: 600; } td.claims { white-space: normal; min-width: 330px; font-size: 12.5px; } td.best { font-weight: 700; } td.kept { color: #0a6b4f; }
td.none { color: var(--muted); }
@media print { body { background: white; } section { border: 0; padding: 0; break-inside: avoid-page; } }
)";

/// "3.2·10⁻⁷" as "3.2e-07" without its leading zeros.
std::string number(double value, int digits) {
    std::string text = formatNumber(value, digits);
    for (const char* zero : {"e-0", "e+0"})
        if (const auto at = text.find(zero); at != std::string::npos) text.erase(at + 2, 1);
    return text;
}
std::string seconds(double value) {
    if (value < 1e-3) return number(value * 1e6, 3) + " µs";
    return value < 1 ? number(value * 1e3, 3) + " ms" : number(value, 3) + " s";
}

std::string cell(const std::string& text, const char* kind = "") {
    if (text.empty()) return "<td class=\"none\">–</td>";
    return (*kind ? "<td class=\"" + std::string(kind) + "\">" : std::string("<td>")) + markupText(text) +
           "</td>";
}
const char* kindOf(Verdict verdict) {
    return verdict == Verdict::below ? "below" : verdict == Verdict::kept ? "kept" : "";
}
std::string known(double value, int digits) { return std::isfinite(value) ? number(value, digits) : ""; }

std::string claimsText(const Claims& claims) {
    std::string text;
    const auto add = [&](const std::string& word) { text += (text.empty() ? "" : ", ") + word; };
    if (claims.isSymplectic) add("symplectic");
    if (claims.isSymmetric) add("symmetric");
    for (const std::string& each : claims.conserves) add(each);
    return text;
}

std::string tableOf(const AtlasSystem& system, const std::vector<AtlasRow>& rows) {
    const auto least = [&](double AtlasRow::*member) {
        double best = HUGE_VAL;
        for (const AtlasRow& row : rows)
            if (row.*member < best) best = row.*member;
        return best;
    };
    const double cheapest = least(&AtlasRow::secondsForError);
    std::string html =
        "<div class=\"wide\"><table>\n<thead><tr><th>scheme</th><th>order<br/>claimed</th>"
        "<th>order<br/>measured</th><th>error</th><th>CPU time</th><th>CPU time<br/>for 1e-6</th>";
    for (std::size_t i = 1; i < system.parts.size(); ++i)
        html += "<th>" + markupText(system.parts[i].metric) + "</th>";
    html += "<th class=\"text\">claims</th><th class=\"text\">ended</th></tr></thead>\n<tbody>\n";
    for (const AtlasRow& row : rows) {
        html += "<tr>" + cell(row.label) +
                cell(row.claims.order > 0 ? std::to_string(row.claims.order) : "") +
                cell(known(row.order.order, 3), kindOf(row.orderVerdict())) + cell(known(row.error, 3)) +
                cell(std::isfinite(row.seconds) ? seconds(row.seconds) : "") +
                cell(std::isfinite(row.secondsForError) ? seconds(row.secondsForError) : "",
                     row.secondsForError == cheapest ? "best" : "");
        for (const AtlasRow::Measured& m : row.metrics)
            html += cell(known(m.value, 2), kindOf(row.verdictOf(m)));
        html += cell(claimsText(row.claims), "text claims") + cell(row.cause, "text") + "</tr>\n";
    }
    return html + "</tbody></table></div>\n";
}

}  // namespace

std::string atlasPage(const std::vector<AtlasSystem>& systems, const std::string& version,
                      const std::string& machine, bool isComplete) {
    std::string sections, links;
    int cases = 0, kept = 0, below = 0, unknown = 0;
    for (const AtlasSystem& system : systems) {
        const std::vector<AtlasRow> rows = rowsOf(system);
        cases += static_cast<int>(rows.size());
        for (const AtlasRow& row : rows) {
            const Verdict v = row.orderVerdict();
            ++(v == Verdict::kept ? kept : v == Verdict::below ? below : unknown);
        }
        const Scene& scene = system.errors().scene().scene;
        links += "<a href=\"#" + system.id + "\">" + markupText(system.title) + "</a> ";
        sections += "<section id=\"" + system.id + "\">\n<h2>" + markupText(system.title) +
                    "</h2>\n<p class=\"muted\">" + "preset <code>" + system.id +
                    "</code>, t = " + number(scene.start.value, 6) + " to " + number(scene.end.value, 6) +
                    ", compared at h = " + number(system.step, 4) +
                    "; reference: " + markupText(system.errors().reference().type) +
                    (std::isfinite(system.errors().reference().estimatedError)
                         ? ", good to " + number(system.errors().reference().estimatedError, 1)
                         : "") +
                    "</p>\n<img src=\"" + system.id + ".svg\" alt=\"Errors against CPU time of " +
                    std::to_string(rows.size()) + " schemes\"/>\n" + tableOf(system, rows) + "</section>\n";
    }
    return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
           "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
           "<title>Atlas of schemes</title>\n<style>" +
           std::string(style) +
           "</style>\n</head>\n<body>\n<main>\n<h1>Atlas of schemes</h1>\n<p class=\"muted\">Extremal " +
           markupText(version) + "; measured on " + markupText(machine) + ".</p>\n" +
           (isComplete ? "" : "<p><strong>Interrupted: not all of it has been measured.</strong></p>\n") +
           "<p>" + std::to_string(cases) +
           " pairs of a scheme and a system. The measured order is the claimed one, or above, in " +
           std::to_string(kept) + "; below it in " + std::to_string(below) + "; in " +
           std::to_string(unknown) +
           " no order could be measured, because errors do not lie on a line at these steps or stay large, "
           "or "
           "there are no steps. Plots show the schemes on the front and the ten cheapest for 1e-6. "
           "Errors, times and changes of what is conserved are those at one step, or at the largest "
           "tolerance that "
           "ran; the last time is interpolated. Green is a claim that is kept, red one that is not seen "
           "here.</p>\n<nav>" +
           links + "</nav>\n" + sections + "</main>\n</body>\n</html>\n";
}

}  // namespace extremal
