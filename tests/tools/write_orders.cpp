// SPDX-License-Identifier: GPL-3.0-or-later
/// Writes the handbook's page of measured orders: tool.orders FILE. Takes some minutes.
#include <atomic>
#include <cstdio>
#include <fstream>
#include <thread>
#include <vector>

#include "tests/tools/order_table.hpp"

int main(int count, char** arguments) {
    using namespace extremal::tools;
    if (count != 2) {
        std::fprintf(stderr, "usage: %s FILE\n", arguments[0]);
        return 2;
    }
    std::vector<OrderRow> rows = pairsOfTable();
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
        for (std::size_t i = next++; i < rows.size(); i = next++) {
            measure(rows[i], orderBudget);
            std::printf("%s", (rows[i].spaceText + ": " + rowText(rows[i])).c_str());
            std::fflush(stdout);
        }
    };
    {
        std::vector<std::jthread> pool;
        for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i) pool.emplace_back(work);
        work();
    }
    std::ofstream file(arguments[1], std::ios::binary);
    file << ordersPage(rows);
    return file.flush() ? 0 : 1;
}
