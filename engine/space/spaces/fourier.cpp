/// Wave functions: Fourier in space, polynomials of one degree in time.
#include "engine/space/catalog.hpp"
#include "engine/space/polynomial.hpp"

namespace extremal::spaces {

SpaceEntry fourier() {
    FieldInfo degree;
    degree.key = degree.title = "degree";
    degree.symbol = "s";
    degree.type = FieldType::integer;
    degree.min = 1;
    degree.max = 16;
    degree.description = "Degree of the polynomials in time on one step.";
    degree.whyLimits = "a curve of degree 0 stands still; above 16 more steps are cheaper than a higher degree";
    FieldInfo shift;
    shift.key = "energy_shift";
    shift.title = "energy shift";
    shift.symbol = "Ec";
    shift.type = FieldType::json;
    shift.fallback = "mean";
    shift.description = "Energy counted from here, a choice of gauge: mean (the energy of the start), or a number.";
    FieldInfo form;
    form.key = form.title = "form";
    form.type = FieldType::choice;
    form.fallback = "one-step";
    form.choices = {"one-step", "three-level"};
    form.description = "One step with its own momentum, or the three levels of the discrete Euler-Lagrange equations (degree 1).";
    FieldInfo start;
    start.key = start.title = "start";
    start.type = FieldType::choice;
    start.fallback = "gauss";
    start.choices = {"gauss", "variational", "exact"};
    start.description = "First step of the three-level form.";
    SpaceEntry e;
    e.item = {"fourier", "Fourier",
              "Wave functions: Fourier modes in space, as many as the model has, and polynomials in time.",
              {degree, shift, form, start}, {},
              "a wave function"};
    e.make = [](const Settings& settings) {
        return polynomialSpace<double>(settings.integer("degree"), PolynomialBasis::lobatto);
    };
    e.applies = [](const System& system) { return system.hasWave(); };
    return e;
}

}  // namespace extremal::spaces
