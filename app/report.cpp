// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/report.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <set>
#include <utility>

#include "app/verbs.hpp"
#include "engine/core/text/markup.hpp"
#include "engine/core/text/text.hpp"
#include "engine/scene/outlook/topics.hpp"
#include "ui/pictures/snapshot.hpp"

namespace extremal::app {

void printProblem(std::string_view where, std::string_view what, std::string_view hint) {
    // A message may go on with lines that show the place; the hint belongs to its first line.
    const auto lineEnd = std::min(what.find('\n'), what.size());
    std::string text = "extremal: ";
    if (!where.empty()) text.append(where).append(": ");
    text.append(what.substr(0, lineEnd));
    if (!hint.empty()) text.append(" (").append(hint).append(")");
    text.append(what.substr(lineEnd)).append("\n");
    text = visibleText(text);  // a key of a scene must not steer the terminal
    std::fwrite(text.data(), 1, text.size(), stderr);
}

void printProblems(const std::string& file, const std::vector<Problem>& problems, std::string_view lead) {
    std::set<std::string> said;
    for (const Problem& p : problems) {
        std::string where = p.origin.empty() ? file : "--set " + p.origin;
        if (p.origin.empty() && !p.pointer.empty()) where += ":" + p.pointer;
        if (!said.insert(where + '\n' + p.message).second || said.size() > mostProblems) continue;
        printProblem(where, std::string(lead) + p.message, p.hint);
    }
    if (said.size() > mostProblems)
        printProblem(file, std::string(lead) + "and " + std::to_string(said.size() - mostProblems) + " more");
}

int tellUnusable(const InvalidScene& error, const std::string& file) {
    for (const Problem& p : error.problems())
        if (p.pointer.starts_with("--"))
            printProblem(p.pointer, p.message, p.hint);
        else
            printProblems(file, {p});
    return unusable;
}

int tellUnwritable(const ExportError& error) {
    const bool isForeign = dynamic_cast<const ForeignFile*>(&error) != nullptr;
    printProblem(error.path.string(), std::string("cannot be written: ") + error.what(),
                 isForeign ? "--force replaces it, or choose another --out" : "another --out");
    return unwritable;
}

int tellUndrawn(const SnapshotError& error) {
    printProblem(error.where, error.what(), error.hint);
    return error.kind == SnapshotError::Kind::unwritable ? unwritable : unusable;
}

int print(std::string_view text, int code) {
    const bool isWritten =
        std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
    if (isWritten) return code;
    printProblem("standard output", std::string("cannot be written: ") + std::strerror(errno));
    return unwritable;
}

std::string Table::text() const {
    std::vector<std::size_t> widths;
    for (const auto& row : rows)
        for (std::size_t c = 0; c < row.size(); ++c) {
            widths.resize(std::max(widths.size(), row.size()));
            widths[c] = std::max(widths[c], codePoints(row[c]));
        }
    std::string text;
    for (const auto& row : rows) {
        std::string line;
        for (std::size_t c = 0; c < row.size(); ++c) {
            const std::string gap(widths[c] - codePoints(row[c]), ' ');
            if (c > 0) line += "  ";
            line += c < isRightAligned.size() && isRightAligned[c] ? gap + row[c] : row[c] + gap;
        }
        line.erase(line.find_last_not_of(' ') + 1);
        text.append(line).append("\n");
    }
    return text;
}

void setProblems(Value& document, const std::string& key, const std::vector<Problem>& problems) {
    Value::Array all;
    for (const Problem& p : problems) {
        if (all.size() == mostProblems) break;
        Value problem{Value::Object{}};
        problem.set("pointer", p.pointer);
        problem.set("message", p.message);
        problem.set("hint", p.hint);
        problem.set("handbook", handbookPlace(p));
        all.push_back(problem);
    }
    document.set(key, std::move(all));
    if (problems.size() > mostProblems)
        document.set(key + "_left_out", static_cast<double>(problems.size() - mostProblems));
}

}  // namespace extremal::app
