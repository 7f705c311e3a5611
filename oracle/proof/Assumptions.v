(* What the theorems rest on, besides Coq's kernel: held against assumptions.txt. *)
From Lorentz Require Import Main Answers Euclid Rows Engine.
Print Assumptions check_sound.
Print Assumptions one_answer.
Print Assumptions remainder_exact.
Print Assumptions euclid_ok.
Print Assumptions two_rows.
Print Assumptions fly_right.
