#include "jawari/detail/index_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace jawari {
namespace {

std::vector<std::uint32_t> values(const IndexList& list) {
    return {list.begin(), list.end()};
}

/// Random operations on the list and on a vector: they hold the same indices after each.
TEST(IndexList, DoesWhatAVectorDoes) {
    std::mt19937 random(1);
    const auto below = [&](std::size_t n) { return static_cast<std::uint32_t>(random() % n); };
    IndexList list;
    list.allocate(30);
    std::vector<std::uint32_t> model;
    for (int n = 0; n < 5000; ++n) {
        const std::uint32_t index = below(40);
        const std::uint32_t kind = below(40);
        if (kind == 0) {
            list.clear();
            model.clear();
        } else if (kind == 1) {
            list.fill_to(index % 30);
            model.clear();
            for (std::uint32_t i = 0; i < index % 30; ++i) model.push_back(i);
        } else if (kind == 2) {
            list.filter([](std::uint32_t i) { return i % 3 != 0; });
            std::erase_if(model, [](std::uint32_t i) { return i % 3 == 0; });
        } else if (kind < 14) {
            list.remove(index);
            const auto found = std::find(model.begin(), model.end(), index);
            if (found != model.end()) model.erase(found);
        } else if (model.size() < 30 && kind < 26) {
            list.push(index);
            model.push_back(index);
        } else if (model.size() < 30) {
            const bool wanted = below(2) == 0;
            list.push_if(wanted, index);
            if (wanted) model.push_back(index);
        }
        ASSERT_EQ(values(list), model) << n;
        ASSERT_EQ(list.size(), model.size());
        ASSERT_EQ(list.empty(), model.empty());
        ASSERT_EQ(list.span().size(), model.size());
        if (!model.empty()) {
            ASSERT_EQ(list[model.size() - 1], model.back());
        }
    }
}

TEST(IndexList, StorageStaysWhereItIs) {
    IndexList list, other;
    list.allocate(8);
    other.allocate(8);
    const std::uint32_t* storage = list.data();
    for (std::uint32_t i = 0; i < 8; ++i) list.push(i);
    list.clear();
    other.push(5);
    list = other;
    EXPECT_EQ(list.data(), storage);
    EXPECT_EQ(list.capacity(), 8U);
    EXPECT_EQ(values(list), std::vector<std::uint32_t>{5});
}

}  // namespace
}  // namespace jawari
