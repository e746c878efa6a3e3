/**
# Independent pieces of work on two threads */
#pragma once

#include <cstddef>
#include <functional>

namespace rotor_stator
{

/** Calls `work` for each of `pieces` numbers, in order but two at a time. After a piece that throws
    none is begun; its exception is thrown when the other thread has ended. */
void on_two_threads(std::size_t pieces,
                    const std::function<void(std::size_t piece)>& work);

}  // namespace rotor_stator
