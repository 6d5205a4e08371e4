// SPDX-License-Identifier: GPL-3.0-or-later
/// The layers of one kind among the layers of a figure, as a range of references. A layer is a std::variant;
/// Variant and L are both const where the figure is.
#pragma once

#include <cstddef>
#include <iterator>
#include <stdexcept>
#include <type_traits>
#include <variant>

namespace extremal {

template <class L, class Variant>
class LayerRange {
public:
    class Iterator {
    public:
        using iterator_category = std::forward_iterator_tag;
        using value_type = std::remove_const_t<L>;
        using difference_type = std::ptrdiff_t;
        using pointer = L*;
        using reference = L&;

        Iterator() = default;
        Iterator(Variant* at, Variant* end) : at_(at), end_(end) { skip(); }
        reference operator*() const { return *std::get_if<value_type>(at_); }
        pointer operator->() const { return std::get_if<value_type>(at_); }
        Iterator& operator++() {
            ++at_;
            skip();
            return *this;
        }
        Iterator operator++(int) {
            const Iterator before = *this;
            ++*this;
            return before;
        }
        bool operator==(const Iterator& other) const { return at_ == other.at_; }

    private:
        void skip() {
            while (at_ != end_ && !std::holds_alternative<value_type>(*at_)) ++at_;
        }
        Variant* at_ = nullptr;
        Variant* end_ = nullptr;
    };

    LayerRange(Variant* first, Variant* last) : first_(first), last_(last) {}
    Iterator begin() const { return {first_, last_}; }
    Iterator end() const { return {last_, last_}; }
    bool empty() const { return begin() == end(); }
    std::size_t size() const { return static_cast<std::size_t>(std::distance(begin(), end())); }
    L& operator[](std::size_t i) const { return *std::next(begin(), static_cast<std::ptrdiff_t>(i)); }
    L& at(std::size_t i) const {
        if (i >= size()) throw std::out_of_range("no such layer");
        return (*this)[i];
    }
    L& front() const { return *begin(); }
    L& back() const { return (*this)[size() - 1]; }

private:
    Variant* first_;
    Variant* last_;
};

}  // namespace extremal
