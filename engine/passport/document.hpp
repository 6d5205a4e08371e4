// SPDX-License-Identifier: GPL-3.0-or-later
/// A page of text, formulas, tables and listings, as a value: written as Markdown, as HTML that needs nothing
/// else, or as LaTeX.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "engine/family/written_action.hpp"

namespace extremal {

struct Document {
    struct Heading {
        std::string text;
    };
    struct Paragraph {
        std::string text;
    };
    struct Formulas {
        std::vector<WrittenFormula> lines;
    };
    struct Table {
        std::vector<std::string> columns;
        std::vector<std::vector<std::string>> rows;
    };
    /// Lines of fixed width.
    struct Listing {
        std::vector<std::string> lines;
    };
    using Block = std::variant<Heading, Paragraph, Formulas, Table, Listing>;

    std::string title;
    std::vector<Block> blocks;
};

enum class PageFormat { markdown, html, latex };

std::string written(const Document& document, PageFormat format);
/// The same for a file, with the mark by which it is known later (engine/run/files/replacing.hpp).
std::string writtenForFile(const Document& document, PageFormat format);

}  // namespace extremal
