// SPDX-License-Identifier: GPL-3.0-or-later
/// A CSV file of numbers that somebody else wrote, line after line; what is wrong is said with its line.
/// Cells may be quoted, an empty one or `nan` is not known, and empty lines are left out, as lines that begin
/// with # are.
#pragma once

#include <cstddef>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

namespace extremal {

class CsvLines {
public:
    /// Reads the first line, the names of the columns. Throws InvalidScene (at `pointer`) where there is
    /// none, or where cells are separated by something other than commas. `wanted`: what the file should be,
    /// for people.
    CsvLines(std::istream& in, std::string name, std::string pointer, std::string wanted);

    const std::vector<std::string>& names() const { return names_; }
    /// What the lines with # before the names say, without the #, as one text; empty: nothing.
    const std::string& remark() const { return remark_; }
    /// The place of a column; `nowhere` where there is none.
    static constexpr auto nowhere = static_cast<std::size_t>(-1);
    std::size_t placeOf(std::string_view name) const;

    /// The cells of the next line, as many as names; false at the end. They are valid until the next call.
    bool next();
    /// The number in a cell of the line; NaN where it is not known.
    double numberAt(std::size_t place) const;

    /// Throws InvalidScene that names the file, or the line as well.
    [[noreturn]] void fail(const std::string& what, const std::string& hint) const;
    [[noreturn]] void failHere(const std::string& what, const std::string& hint) const;

private:
    bool readLine();

    std::istream& in_;
    std::string name_, pointer_, text_, remark_;
    std::vector<std::string> names_;
    std::vector<std::string_view> cells_;
    int line_ = 0;
};

}  // namespace extremal
