/**
# Independent pieces of work on two threads */
#pragma once

#include <cstddef>
#include <functional>

namespace rotor_stator
{

/** Calls `work` for each of `pieces` numbers, in order but two at a time. After a piece that throws
    none is begun; when both threads have ended the exception is thrown, of two that of the earlier piece. */
void on_two_threads(std::size_t pieces,
                    const std::function<void(std::size_t piece)>& work);

}  // namespace rotor_stator
