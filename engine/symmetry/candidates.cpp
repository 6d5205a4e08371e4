// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/symmetry/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>

#include "engine/core/text/text.hpp"

namespace extremal {
namespace {

Symmetry nothing(int d) {
    Symmetry s;
    const auto n = static_cast<std::size_t>(d);
    s.dimension = d;
    s.A.assign(n * n, 0);
    s.b.assign(n, 0);
    s.c.assign(n, 0);
    return s;
}

/// Coordinates by direction, in the order of their first occurrence.
std::vector<std::pair<std::string, std::vector<int>>> directions(const System& system) {
    std::vector<std::pair<std::string, std::vector<int>>> all;
    for (int i = 0; i < system.dimension(); ++i) {
        const std::string direction = directionOf(system.coordinates[static_cast<std::size_t>(i)]);
        auto at =
            std::find_if(all.begin(), all.end(), [&](const auto& each) { return each.first == direction; });
        if (at == all.end()) at = all.insert(all.end(), {direction, {}});
        at->second.push_back(i);
    }
    return all;
}

/// "3", "1/4", "0.123457": as people write it.
std::string numberText(double x) {
    for (int denominator = 1; denominator <= 64; ++denominator)
        if (const double n = std::round(x * denominator);
            n != 0 && std::abs(x * denominator - n) < 1e-12 * std::abs(n) && std::abs(n) < 1000)
            return formatNumber(n) + (denominator > 1 ? "/" + std::to_string(denominator) : "");
    return formatNumber(x, 6);
}

/// sum coefficient * factor, as "x/2 - 3 y + 5"; an empty factor stands alone.
class Sum {
public:
    void add(double coefficient, const std::string& factor) {
        if (coefficient == 0) return;
        const bool isNegative = coefficient < 0;
        text_ += text_.empty() ? (isNegative ? "-" : "") : (isNegative ? " - " : " + ");
        const std::string number = numberText(std::abs(coefficient));
        if (factor.empty())
            text_ += number;
        else if (number == "1")
            text_ += factor;
        else if (number.starts_with("1/"))
            text_ += factor + number.substr(1);
        else
            text_ += number + " " + factor;
    }
    const std::string& text() const { return text_; }

private:
    std::string text_;
};

class Namer {
public:
    explicit Namer(const System& system) : system_(system), directions_(directions(system)) {}

    void name(Symmetry& s) const {
        const bool hasA = hasNonzero(s.A), hasB = hasNonzero(s.b), hasC = hasNonzero(s.c);
        s.generator = generatorText(s);
        if (s.movesTime()) {
            s.kind = s.tau1 != 0 ? SymmetryKind::scaling : SymmetryKind::time;
            const bool isPure = !hasA && !hasB && !hasC && s.F.empty() && s.tau1 == 0;
            s.name = isPure ? "energy" : s.tau1 != 0 ? "scaling" : "time";
            s.title = isPure ? "translation in time (energy)"
                             : (s.tau1 != 0 ? "scaling" : "translation in time with scaling") + inBrackets(s);
        } else if (!hasA && hasC) {
            s.kind = SymmetryKind::boost;
            s.name = "boost." + along(s.c);
            s.title = "boost in " + along(s.c);
        } else if (!hasA) {
            s.kind = SymmetryKind::translation;
            s.name = "translation." + along(s.b);
            s.title = "translation in " + along(s.b);
        } else if (const std::string plane = planeOf(s); !plane.empty()) {
            s.kind = SymmetryKind::rotation;
            s.name = "rotation." + plane;
            s.title = "rotation in the plane " + plane + centreText(s) + (isCircular(s) ? "" : inBrackets(s));
        } else {
            s.kind = SymmetryKind::linear;
            s.name = "linear";
            s.title = "linear" + inBrackets(s);
        }
    }

private:
    /// The generator where it is short enough for a title.
    static std::string inBrackets(const Symmetry& s) {
        return s.generator.size() > 50 ? "" : " (" + s.generator + ")";
    }
    const std::string& nameOf(int i) const { return system_.coordinates[static_cast<std::size_t>(i)].name; }

    /// The direction of a vector: a coordinate, a direction of all bodies, or a sum.
    std::string along(const std::vector<double>& vector) const {
        Sum sum;
        std::set<int> support;
        bool isEqual = true;
        for (std::size_t i = 0; i < vector.size(); ++i) {
            if (vector[i] == 0) continue;
            isEqual = isEqual && vector[i] == 1;
            support.insert(static_cast<int>(i));
            sum.add(vector[i], nameOf(static_cast<int>(i)));
        }
        if (isEqual && support.size() > 1)
            for (const auto& [direction, members] : directions_)
                if (support == std::set<int>(members.begin(), members.end())) return direction;
        std::string text = sum.text();
        std::erase(text, ' ');
        return text;
    }
    /// "x-y" where A mixes coordinates of two directions pairwise, with opposite signs; else empty.
    std::string planeOf(const Symmetry& s) const {
        std::set<std::pair<std::string, std::string>> planes;
        std::string only;
        int pairs = 0;
        for (int i = 0; i < s.dimension; ++i) {
            if (s.a(i, i) != 0) return {};
            for (int j = 0; j < i; ++j) {
                if (s.a(i, j) == 0 && s.a(j, i) == 0) continue;
                if (!(s.a(i, j) * s.a(j, i) < 0)) return {};
                const std::string u = directionOf(coordinate(j)), v = directionOf(coordinate(i));
                planes.insert(std::minmax(u, v));
                only = nameOf(j) + "-" + nameOf(i);
                ++pairs;
            }
        }
        if (pairs == 1) return only;
        if (planes.size() != 1 || planes.begin()->first == planes.begin()->second) return {};
        // All bodies turn alike.
        for (int i = 0; i < s.dimension; ++i) {
            int partners = 0;
            for (int j = 0; j < s.dimension; ++j) partners += s.a(i, j) != 0;
            if (partners > 1) return {};
        }
        return planes.begin()->first + "-" + planes.begin()->second;
    }
    const Coordinate& coordinate(int i) const { return system_.coordinates[static_cast<std::size_t>(i)]; }
    static bool isCircular(const Symmetry& s) {
        for (int i = 0; i < s.dimension; ++i)
            for (int j = 0; j < i; ++j)
                if (s.a(i, j) != -s.a(j, i)) return false;
        return true;
    }
    /// " about (5, -3)" where a rotation of one pair of coordinates keeps another point than the origin.
    static std::string centreText(const Symmetry& s) {
        if (!hasNonzero(s.b)) return {};
        for (int i = 0; i < s.dimension; ++i)
            for (int j = 0; j < i; ++j)
                if (s.a(i, j) != 0) {
                    const double x = -s.b[static_cast<std::size_t>(i)] / s.a(i, j),
                                 y = -s.b[static_cast<std::size_t>(j)] / s.a(j, i);
                    return " about (" + formatNumber(x + 0.0, 6) + ", " + formatNumber(y + 0.0, 6) + ")";
                }
        return {};
    }
    /// "x: -y - 3, y: x - 5, t: 2 t; F = y/2".
    std::string generatorText(const Symmetry& s) const {
        std::string text;
        const auto put = [&](const std::string& name, const Sum& sum) {
            if (!sum.text().empty()) text += (text.empty() ? "" : ", ") + name + ": " + sum.text();
        };
        for (int i = 0; i < s.dimension; ++i) {
            Sum sum;
            for (int j = 0; j < s.dimension; ++j) sum.add(s.a(i, j), nameOf(j));
            sum.add(s.c[static_cast<std::size_t>(i)], "t");
            sum.add(s.b[static_cast<std::size_t>(i)], "");
            put(nameOf(i), sum);
        }
        Sum time, gauge;
        time.add(s.tau1, "t");
        time.add(s.tau0, "");
        put("t", time);
        for (const GaugeTerm& term : s.F) {
            std::map<int, int> powers;  // in the order of the coordinates
            for (const int i : {term.i, term.j, term.k})
                if (i >= 0) ++powers[i];
            std::string factor;
            const auto multiply = [&](const std::string& name, int power) {
                factor += (factor.empty() ? "" : " ") + name + (power > 1 ? "^" + std::to_string(power) : "");
            };
            for (const auto& [i, power] : powers) multiply(nameOf(i), power);
            if (term.power > 0) multiply("t", term.power);
            gauge.add(term.coefficient, factor);
        }
        return gauge.text().empty() ? text : text + "; F = " + gauge.text();
    }

    const System& system_;
    std::vector<std::pair<std::string, std::vector<int>>> directions_;
};

/// F = sum_k c_i L_v_i,v_k q_k, for which a boost of free bodies changes L by dF/dt.
void addBoostGauge(const System& system, Symmetry& s) {
    const Mechanical& m = system.mechanics();
    const auto d = static_cast<std::size_t>(s.dimension);
    std::vector<double> q(d, 1), v(d, 0), gradient(2 * d), hessian(4 * d * d);
    for (std::size_t i = 0; i < d; ++i) q[i] += 0.37 * static_cast<double>(i);  // bodies apart
    double L = 0;
    m.jet(m.model.get(), 0, q.data(), v.data(), &L, gradient.data(), hessian.data());
    for (std::size_t k = 0; k < d; ++k) {
        double mass = 0;
        for (std::size_t i = 0; i < d; ++i) mass += s.c[i] * hessian[(d + i) * 2 * d + d + k];
        if (mass != 0) s.F.push_back({static_cast<int>(k), -1, -1, 0, mass});
    }
}

}  // namespace

std::string directionOf(const Coordinate& coordinate) {
    const std::string& name = coordinate.name;
    if (const auto dot = name.rfind('.'); dot != std::string::npos) return name.substr(dot + 1);
    const std::string letters = name.substr(0, name.find_first_of("_0123456789"));
    return letters.empty() ? name : letters;
}

std::vector<Symmetry> candidates(const System& system) {
    const int d = system.dimension();
    const auto all = directions(system);
    std::vector<Symmetry> found;
    const auto add = [&](auto&& fill) {
        Symmetry s = nothing(d);
        fill(s);
        found.push_back(std::move(s));
    };
    for (int i = 0; i < d; ++i) add([&](Symmetry& s) { s.b[static_cast<std::size_t>(i)] = 1; });
    for (const auto& [direction, members] : all)
        if (members.size() > 1)
            add([&, &members = members](Symmetry& s) {
                for (const int i : members) s.b[static_cast<std::size_t>(i)] = 1;
            });
    for (std::size_t u = 0; u < all.size(); ++u)
        for (std::size_t v = u + 1; v < all.size(); ++v) {
            const auto &first = all[u].second, &second = all[v].second;
            if (first.size() != second.size()) continue;
            add([&](Symmetry& s) {
                for (std::size_t n = 0; n < first.size(); ++n) {
                    s.a(second[n], first[n]) = 1;
                    s.a(first[n], second[n]) = -1;
                }
            });
        }
    for (const auto& [direction, members] : all)
        add([&, &members = members](Symmetry& s) {
            for (const int i : members) s.c[static_cast<std::size_t>(i)] = 1;
            addBoostGauge(system, s);
        });
    add([](Symmetry& s) { s.tau0 = 1; });
    return found;
}

void nameAll(const System& system, std::span<Symmetry> symmetries) {
    const Namer namer(system);
    std::map<std::string, int> used;
    for (Symmetry& s : symmetries) {
        namer.name(s);
        if (const int times = ++used[s.name]; times > 1) s.name += "-" + std::to_string(times);
    }
}

}  // namespace extremal
