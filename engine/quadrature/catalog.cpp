#include "engine/quadrature/catalog.hpp"

namespace extremal {
namespace {

FieldInfo count(std::string key, std::string title, double min, std::string description) {
    FieldInfo f = integerField(key, key, min, 1000, nullptr, std::move(description));
    f.title = std::move(title);
    return f;
}

FieldInfo side() {
    return choiceField("end", "end that is a node", {"right", "left"}, "Which end of the step is a node.");
}

FieldInfo filonNodes(double min) {
    return count("nodes", "nodes", min,
                 "Number of slow nodes; default: the highest degree in the space plus two.");
}
FieldInfo phases() {
    return count("phases", "phases", 1,
                 "Number of phases at each node; default: 4 H + 4, H the highest harmonic in the space.");
}

}  // namespace

const std::vector<CatalogItem>& quadratureCatalog() {
    const FieldInfo panels = count("panels", "panels", 1,
                                   "The rule is repeated in equal panels; default: the cells of the space.");
    const std::string default0 = "Number of nodes; default: the degree of the space.";
    const std::string default1 = "Number of nodes; default: the degree of the space plus one.";
    static const std::vector<CatalogItem> all = {
        {"gauss",
         "Gauss",
         "Gauss-Legendre: n nodes inside the step, exact to degree 2n - 1.",
         {count("nodes", "nodes", 1, default0), panels},
         {},
         ""},
        {"lobatto",
         "Lobatto",
         "Gauss-Lobatto: both ends are nodes, exact to degree 2n - 3.",
         {count("nodes", "nodes", 2, default1), panels},
         {},
         ""},
        {"radau",
         "Radau",
         "Gauss-Radau: one end is a node, exact to degree 2n - 2; not symmetric.",
         {count("nodes", "nodes", 1, default0), side(), panels},
         {},
         ""},
        {"clenshaw-curtis",
         "Clenshaw-Curtis",
         "Chebyshev extrema: both ends are nodes, exact to degree n - 1 (n for odd n).",
         {count("nodes", "nodes", 2, default1), panels},
         {},
         ""},
        {"midpoint",
         "midpoint",
         "The middle of the step, or of each of several equal panels.",
         {panels},
         {},
         ""},
        {"trapezoid",
         "trapezoid",
         "The two ends of the step, or of each of several equal panels.",
         {panels},
         {},
         ""},
        {"exact",
         "exact",
         "The integral itself, where it is known: wave functions in three-level form.",
         {},
         {},
         ""},
        {"filon-lobatto",
         "Filon-Lobatto",
         "For oscillatory spaces: Lobatto's nodes times equally spaced phases, exact for each harmonic; the "
         "cost does not "
         "depend on the frequency.",
         {filonNodes(2), phases()},
         {},
         "an oscillatory space"},
        {"filon-gauss",
         "Filon-Gauss",
         "The same on Gauss' nodes: exact to a higher degree where nothing oscillates, and less "
         "accurate by a factor step * frequency where it does.",
         {filonNodes(1), phases()},
         {},
         "an oscillatory space"},
        {"auto",
         "automatic",
         "Chosen for the space: Gauss with as many nodes as the degree; for an oscillatory space the cheaper "
         "of Filon-Lobatto "
         "and 24 Gauss points a period, Filon from some three periods a step on.",
         {},
         {},
         ""},
    };
    return all;
}

}  // namespace extremal
