// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/branches.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "engine/core/switching.hpp"
#include "engine/model/typed/typed_mechanics.hpp"

namespace extremal::typed {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// The marks of a table: where the polynomial of a piece is expanded about, and its coefficients.
std::size_t marksOf(const Interpolant* table) {
    return table ? static_cast<std::size_t>(table->degree()) + 2 : 1;
}

}  // namespace

/// Finds the switches of a formula and writes it anew.
class BranchReader {
public:
    explicit BranchReader(const Formula& formula) : formula_(formula), resolved_(resolve(formula)) {
        const std::size_t count = resolved_.expression.nodes.size();
        symbols_.resize(count, 0);
        for (std::size_t n = 0; n < count; ++n) {
            const Expression::Node& node = resolved_.expression.nodes[n];
            if (const int symbol = resolved_.symbol[n]; symbol >= 0)
                symbols_[n] = symbolsOf(symbol);
            else
                for (const int part : {node.left, node.right, node.third})
                    if (part >= 0) symbols_[n] |= symbols_[static_cast<std::size_t>(part)];
        }
    }

    std::shared_ptr<const Branches> read() {
        const std::size_t count = resolved_.expression.nodes.size();
        for (std::size_t n = 0; n < count; ++n)
            if (symbols_[n] != 0) consider(static_cast<int>(n));
        if (made_->switches_.empty()) return nullptr;
        Formula& frozen = made_->frozen_;
        frozen = formula_;
        frozen.terms.clear();
        frozen.text = written(static_cast<int>(count) - 1);
        made_->ownParameters_ = formula_.parameters.size();
        for (const std::string& name : marks_) frozen.parameters.emplace_back(name, 1.0);
        for (Branches::Switch& s : made_->switches_) {
            Formula argument = frozen;
            argument.text = s.text;
            s.argument = resolve(argument);
            for (const int symbol : s.argument.symbol)
                s.moves = s.moves || (symbol >= 0 && symbol <= formula_.time());
        }
        return made_;
    }

private:
    enum Symbols : unsigned { ofTime = 1, ofPlaces = 2, ofVelocities = 4 };
    using Kind = Branches::Kind;

    unsigned symbolsOf(int symbol) const {
        if (symbol == formula_.time()) return ofTime;
        if (symbol >= formula_.firstParameter()) return 0;
        return symbol >= formula_.dimension() ? ofVelocities : ofPlaces;
    }
    const Expression::Node& node(int n) const {
        return resolved_.expression.nodes[static_cast<std::size_t>(n)];
    }
    std::string written(int n) const {
        return writtenPart(resolved_.expression, n,
                           [this](int part, const WritePart& write) { return frozen(part, write); });
    }

    void consider(int n) {
        const Expression::Node& here = node(n);
        if (here.kind != Operator::call) return;
        const auto quotient = [&](const char* sign) {
            return "(" + written(here.left) + ")" + sign + "(" + written(here.right) + ")";
        };
        const std::string& name = here.name;
        if (here.table)
            add(n, Kind::table, written(here.left), 0, here.table);
        else if (name == "abs" || name == "sign" || name == "heaviside")
            add(n, Kind::sign, written(here.left));
        else if (name == "max" || name == "min" || name == "<" || name == "<=")
            add(n, Kind::sign, quotient("-"));
        else if (name == "floor" || name == "ceil")
            add(n, Kind::steps, written(here.left));
        else if (name == "round")
            add(n, Kind::steps, written(here.left), -0.5);
        else if (name == "mod")
            add(n, Kind::steps, quotient("/"));
    }
    void add(int n, Kind kind, const std::string& text, double offset = 0,
             const std::shared_ptr<const Interpolant>& table = nullptr) {
        auto& all = made_->switches_;
        const auto same = std::find_if(all.begin(), all.end(), [&](const Branches::Switch& s) {
            const bool isSameTable = s.table == table || (s.table && table && *s.table == *table);
            return s.kind == kind && s.text == text && s.offset == offset && isSameTable;
        });
        switchOf_[n] = static_cast<std::size_t>(same - all.begin());
        if (same != all.end()) return;
        Branches::Switch s;
        s.kind = kind;
        s.text = text;
        s.offset = offset;
        s.table = table;
        s.firstMark = marks_.size();
        const unsigned symbols = symbols_[static_cast<std::size_t>(n)];
        s.isOfTime = symbols == ofTime;
        s.hasVelocities = (symbols & ofVelocities) != 0;
        for (std::size_t k = 0; k < marksOf(table.get()); ++k) marks_.push_back(freeName());
        all.push_back(std::move(s));
    }
    /// A name that the formula does not have.
    std::string freeName() const {
        std::string name = "branch" + std::to_string(marks_.size());
        const auto isTaken = [&] {
            return std::any_of(formula_.parameters.begin(), formula_.parameters.end(),
                               [&](const auto& p) { return p.first == name; }) ||
                   std::find(formula_.coordinates.begin(), formula_.coordinates.end(), name) !=
                       formula_.coordinates.end();
        };
        while (isTaken()) name.insert(name.begin(), 'a');
        return name;
    }

    std::optional<std::string> frozen(int n, const WritePart& write) const {
        const auto found = switchOf_.find(n);
        if (found == switchOf_.end()) return {};
        const Expression::Node& here = node(n);
        const Branches::Switch& s = made_->switches_[found->second];
        const std::string& mark = marks_[s.firstMark];
        const auto part = [&](int of) { return "(" + write(of) + ")"; };
        const std::string& name = here.name;
        if (s.table) return polynomial(s, part(here.left));
        if (name == "abs") return mark + "*" + part(here.left);
        if (name == "sign") return mark;
        if (name == "heaviside") return "(1 + " + mark + ")/2";
        if (name == "max") return "if(" + mark + " < 0, " + write(here.right) + ", " + write(here.left) + ")";
        if (name == "min") return "if(" + mark + " > 0, " + write(here.right) + ", " + write(here.left) + ")";
        if (name == "<" || name == "<=") return mark + " " + name + " 0";
        if (name == "ceil") return mark + " + 1";
        if (name == "mod") return part(here.left) + " - " + part(here.right) + "*" + mark;
        return mark;
    }
    std::string polynomial(const Branches::Switch& s, const std::string& argument) const {
        const std::string x = "(" + argument + " - " + marks_[s.firstMark] + ")";
        const std::size_t last = s.firstMark + marksOf(s.table.get()) - 1;
        std::string text = marks_[last];
        for (std::size_t k = last - 1; k > s.firstMark; --k) text = marks_[k] + " + " + x + "*(" + text + ")";
        return text;
    }

    const Formula& formula_;
    ResolvedFormula resolved_;
    std::vector<unsigned> symbols_;  ///< below each node
    std::map<int, std::size_t> switchOf_;
    std::vector<std::string> marks_;
    std::shared_ptr<Branches> made_ = std::make_shared<Branches>();
};

std::shared_ptr<const Branches> Branches::of(const Formula& formula) {
    try {
        return BranchReader(formula).read();
    } catch (const ExpressionError&) {
        return nullptr;  // written anew it may be too long
    }
}

double Branches::argument(std::size_t k, const double* inputs, const Cells& cells) const {
    const Switch& s = switches_[k];
    const auto& nodes = s.argument.expression.nodes;
    thread_local std::vector<double> marks, values;
    marks.resize(frozen_.parameters.size() - ownParameters_);
    for (std::size_t j = 0; j < k; ++j) mark(switches_[j], cells[j], marks.data());
    values.resize(nodes.size());
    const auto at = [&](int n) { return n < 0 ? 0.0 : values[static_cast<std::size_t>(n)]; };
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        const int symbol = s.argument.symbol[n], parameter = symbol - frozen_.firstParameter();
        if (symbol < 0)
            values[n] = applyNode(nodes[n], at(nodes[n].left), at(nodes[n].right), at(nodes[n].third));
        else if (parameter < 0)
            values[n] = inputs[symbol];
        else if (static_cast<std::size_t>(parameter) < ownParameters_)
            values[n] = frozen_.parameters[static_cast<std::size_t>(parameter)].second;
        else
            values[n] = marks[static_cast<std::size_t>(parameter) - ownParameters_];
    }
    return values.back();
}

double Branches::cellOf(std::size_t k, double s) const {
    const Switch& of = switches_[k];
    if (of.kind == Kind::sign) return s > 0 ? 1 : s < 0 ? -1 : 0;
    if (of.kind == Kind::steps) return std::floor(s - of.offset);
    const std::vector<double>& x = of.table->abscissae();
    return static_cast<double>(std::upper_bound(x.begin(), x.end(), s) - x.begin());
}

std::pair<double, double> Branches::limits(std::size_t k, double cell) const {
    const Switch& of = switches_[k];
    if (of.kind == Kind::sign)
        return {cell > 0 || cell == 0 ? 0 : -infinite, cell < 0 || cell == 0 ? 0 : infinite};
    if (of.kind == Kind::steps) return {cell + of.offset, cell + of.offset + 1};
    const std::vector<double>& x = of.table->abscissae();
    const auto piece = static_cast<std::size_t>(cell);
    return {piece == 0 ? -infinite : x[piece - 1], piece == x.size() ? infinite : x[piece]};
}

double Branches::next(std::size_t k, double cell, bool isUpper) const {
    if (switches_[k].kind == Kind::sign) return isUpper ? 1 : -1;
    return cell + (isUpper ? 1 : -1);
}

void Branches::mark(const Switch& s, double cell, double* values) const {
    values += s.firstMark;
    if (!s.table) {
        *values = cell;
        return;
    }
    const auto piece = static_cast<std::size_t>(cell);
    *values = s.table->base(piece);
    for (int power = 0; power <= s.table->degree(); ++power)
        values[1 + power] = s.table->coefficient(piece, power);
}

Mechanics<double> Branches::in(const Cells& cells) const {
    Formula formula = frozen_;
    std::vector<double> marks(formula.parameters.size() - ownParameters_);
    for (std::size_t k = 0; k < switches_.size(); ++k) mark(switches_[k], cells[k], marks.data());
    for (std::size_t i = 0; i < marks.size(); ++i) formula.parameters[ownParameters_ + i].second = marks[i];
    return makeMechanics(formula).mechanics;
}

}  // namespace extremal::typed
