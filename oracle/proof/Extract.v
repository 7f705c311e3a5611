(* The check as a program. Coq's integers become Zarith's: trusted are Coq's own table, ExtrOcamlZBigInt, and
   these lines, which give functions that are not in it the same values, also where the second operand is
   negative. *)
From Coq Require Import ZArith Extraction ExtrOcamlBasic ExtrOcamlZBigInt.
From Lorentz Require Import Number Windows Check.
Extract Constant Z.ltb => "Big_int_Z.lt_big_int".
Extract Constant Z.leb => "Big_int_Z.le_big_int".
Extract Constant Z.land => "(fun x y -> Z.logand x y)".
Extract Constant Z.lor => "(fun x y -> Z.logor x y)".
Extract Constant Z.even => "(fun x -> not (Z.testbit x 0))".
Extract Constant Z.log2 => "(fun x -> Z.of_int (if Z.sign x > 0 then Z.numbits x - 1 else 0))".
Extract Constant Z.sqrt => "(fun x -> if Z.sign x > 0 then Z.sqrt x else Z.zero)".
Extract Constant Z.pow => "(fun x y -> if Z.sign y < 0 then Z.zero else Z.pow x (Z.to_int y))".
Extraction "checker.ml" number end_at_number prepare check_record is_question.
