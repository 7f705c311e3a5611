(* The model of the engine as a program, for comparing it with the engine: flights.ml. As in Extract.v; and the digits
   of a number are counted by Zarith, in base 2, which is the only one here
   (`Zarith` is its Z, which the model's own hides: the Makefile says so in the first line of model.ml). *)
From Coq Require Import ZArith Extraction ExtrOcamlBasic ExtrOcamlZBigInt.
From Flocq Require Import Core.
From Lorentz Require Import Extract Doubles Model.
Extract Constant Digits.Zdigits => "(fun _ n -> Zarith.of_int (Zarith.numbits n))".
Extraction "model.ml" fly turned turn_sign set_direction set_start row_beside_start reach_of_rows slope_of_rows are_in_order offset_of below size_of.
