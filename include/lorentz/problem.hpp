// The exact problem statement, shared by every engine, oracle and reader: scenes, queries and answers. These
// are values without hidden state: copy them, and share them between threads, as you would a double.
#pragma once

#include <lorentz/answer.hpp>
#include <lorentz/obstacle.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>
#include <lorentz/vec.hpp>
