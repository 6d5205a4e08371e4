// SPDX-License-Identifier: GPL-3.0-or-later
/// What a problem is made of, and what a method, an observable or a view takes of it.
///
/// A part that binds the motion (a Lagrangian, a force, a constraint) belongs to its equations: whoever
/// leaves it out computes another problem, and does so plausibly. So the needs of a problem are the binding
/// parts that it has, derived and never stated twice, and a problem is refused where one of its needs is not
/// taken. A part that a method has not been told of is refused by default. Other parts (an exact solution, a
/// picture) may be used or left alone.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace extremal {

/// What the type of a part says of itself, in a static member `part`.
struct PartInfo {
    std::string_view id;     ///< "lagrangian"
    std::string_view title;  ///< for sentences: "a Lagrangian in coordinates"
    bool bindsMotion = true;
};

/// The parts of a problem: one of each type, found by the type. Copies share them; they do not change.
class Parts {
public:
    template <class P>
    void set(P part) {
        auto value = std::make_shared<const P>(std::move(part));
        for (Entry& e : entries_)
            if (e.info == &P::part) {
                e.value = std::move(value);
                return;
            }
        entries_.push_back({&P::part, std::move(value)});
    }
    /// Null where there is no such part.
    template <class P>
    const P* find() const {
        for (const Entry& e : entries_)
            if (e.info == &P::part) return static_cast<const P*>(e.value.get());
        return nullptr;
    }
    /// Those that bind the motion.
    std::vector<const PartInfo*> needs() const {
        std::vector<const PartInfo*> binding;
        for (const Entry& e : entries_)
            if (e.info->bindsMotion) binding.push_back(e.info);
        return binding;
    }

private:
    struct Entry {
        const PartInfo* info;
        std::shared_ptr<const void> value;
    };
    std::vector<Entry> entries_;
};

/// The binding parts that somebody understands.
class Takes {
public:
    template <class... P>
    static Takes only() {
        Takes takes;
        takes.parts_ = {&P::part...};
        return takes;
    }
    /// Of what looks at rows and states alone, whatever moved them.
    static Takes everything() {
        Takes takes;
        takes.isEverything_ = true;
        return takes;
    }
    /// These and others besides.
    template <class... P>
    Takes with() const {
        Takes takes = *this;
        (takes.parts_.push_back(&P::part), ...);
        return takes;
    }
    bool isEverything() const { return isEverything_; }
    const std::vector<const PartInfo*>& all() const { return parts_; }  ///< empty where it is everything
    bool contains(const PartInfo& part) const {
        return isEverything_ || std::find(parts_.begin(), parts_.end(), &part) != parts_.end();
    }

private:
    std::vector<const PartInfo*> parts_;
    bool isEverything_ = false;
};

/// Titles for a sentence: "a force, a wall and a constraint".
std::string joinTitles(const std::vector<const PartInfo*>& parts, std::string_view last);

/// The needs that are not taken: "a force and a constraint"; empty: all are taken.
std::string untaken(const Takes& takes, const Parts& parts);

/// Whether all needs are taken. Whoever takes certain parts needs one of them at least.
bool isTaken(const Takes& takes, const Parts& parts);

/// What is needed in place of a problem that is not taken. Where a part of it is taken, it is the same
/// without the others: "a problem without a force"; else what is taken: "a field or a wave function". Empty:
/// it is taken.
std::string neededInstead(const Takes& takes, const Parts& parts);

}  // namespace extremal
