/// What ranks say to each other while they distribute items, as bytes.
#pragma once

#include "base/error.hpp"
#include "run/comm.hpp"
#include "run/pool.hpp"
#include "run/stopping.hpp"
#include "study/activity.hpp"

#include <cstring>
#include <string>
#include <vector>

namespace bemcal::run {

enum class Tag : int {
    hello,     ///< to rank 0: here I am; the number of my threads
    work,      ///< from rank 0: items
    answers,   ///< to rank 0: finished items
    ask_stop,  ///< to rank 0: a signal, or an error, see Stop
    stop,      ///< from rank 0: begin nothing more
    stopped,   ///< to rank 0: nothing is running here
    how_far,   ///< from rank 0: tell how far your items are
    activity,  ///< to rank 0: the answer
    finish,    ///< from rank 0: leave; see Stop
};

/// Why it all ends: a signal or the time (code more_to_do, no text), an error, or ok: all
/// is done.
struct Stop {
    ExitCode code = ExitCode::ok;
    std::string text;
    Stopping how = Stopping::soon;
};

inline Bytes to_bytes(const Stop& stop) {
    Bytes bytes(2 + stop.text.size());
    bytes[0] = static_cast<std::byte>(stop.code);
    bytes[1] = static_cast<std::byte>(stop.how);
    std::memcpy(bytes.data() + 2, stop.text.data(), stop.text.size());
    return bytes;
}

inline Stop to_stop(const Bytes& bytes) {
    return {static_cast<ExitCode>(bytes[0]),
            {reinterpret_cast<const char*>(bytes.data()) + 2, bytes.size() - 2},
            static_cast<Stopping>(bytes[1])};
}

inline Bytes to_bytes(const std::vector<int>& numbers) {
    Bytes bytes(numbers.size() * sizeof(int));
    std::memcpy(bytes.data(), numbers.data(), bytes.size());
    return bytes;
}

inline std::vector<int> to_numbers(const Bytes& bytes) {
    std::vector<int> numbers(bytes.size() / sizeof(int));
    std::memcpy(numbers.data(), bytes.data(), bytes.size());
    return numbers;
}

inline Bytes to_bytes(const study::Activity& activity) {
    constexpr std::size_t head = sizeof activity.share + sizeof activity.n_items;
    Bytes bytes(head + activity.text.size());
    std::memcpy(bytes.data(), &activity.share, sizeof activity.share);
    std::memcpy(bytes.data() + sizeof activity.share, &activity.n_items,
                sizeof activity.n_items);
    std::memcpy(bytes.data() + head, activity.text.data(), activity.text.size());
    return bytes;
}

inline study::Activity to_activity(const Bytes& bytes) {
    study::Activity activity;
    constexpr std::size_t head = sizeof activity.share + sizeof activity.n_items;
    std::memcpy(&activity.share, bytes.data(), sizeof activity.share);
    std::memcpy(&activity.n_items, bytes.data() + sizeof activity.share,
                sizeof activity.n_items);
    activity.text.assign(reinterpret_cast<const char*>(bytes.data()) + head,
                         bytes.size() - head);
    return activity;
}

/// Appends an item and its packed answer to a message.
inline void append(Bytes& message, const Finished& finished) {
    const std::size_t head[2] = {static_cast<std::size_t>(finished.item),
                                 finished.packed.size()};
    const auto* raw = reinterpret_cast<const std::byte*>(head);
    message.insert(message.end(), raw, raw + sizeof head);
    message.insert(message.end(), finished.packed.begin(), finished.packed.end());
}

/// Calls take(item, data, bytes) for each answer in a message.
template <class Take>
void for_each_answer(const Bytes& message, Take take) {
    std::size_t head[2];
    for (std::size_t at = 0; at < message.size(); at += sizeof head + head[1]) {
        std::memcpy(head, message.data() + at, sizeof head);
        take(static_cast<int>(head[0]), message.data() + at + sizeof head, head[1]);
    }
}

}  // namespace bemcal::run
