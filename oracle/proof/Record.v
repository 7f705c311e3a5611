(* A record decided inside Coq, where neither extraction nor OCaml is trusted: the first case of the tests of
   data/check.py, from (0, 0.445) along (1, 0.0175) between discs of radius 0.1. *)
From Coq Require Import ZArith List.
From Lorentz Require Import Spec Steps Windows Check Main.
Import ListNotations.
Local Open Scope Z_scope.

Definition accepts (sc : scene) (q : query) (a : answer) (c : certificate) (budget : Z) : bool :=
  match prepare sc with
  | Some p => match check_record p q a c budget with inl _ => true | inr _ => false end
  | None => false
  end.
Lemma accepts_ok sc q a c budget : accepts sc q a c budget = true ->
  valid_scene sc /\ valid_query sc q /\ correct sc q a.
Proof.
  unfold accepts. destruct (prepare sc) as [p|] eqn:E; [|discriminate].
  destruct (check_record p q a c budget) as [rest|f] eqn:K; [|discriminate]. intros _.
  apply (check_sound sc p q a c E). exists budget, rest. exact K.
Qed.

Definition square : scene :=
  Scene 2 [Lattice [[Decimal 1 0; Decimal 0 0]; [Decimal 0 0; Decimal 1 0]]
    [Atom [Decimal 0 0; Decimal 0 0] (Radius (Decimal 1 (-1)))]].
Definition flight : query := Query [Decimal 0 0; Decimal 445 (-3)] [Decimal 1 0; Decimal 175 (-4)] None.
Definition hit : answer :=
  Hit (Obstacle 0 0 [26; 1]) (Some (Decimal 25999999999999996 (-15))) 2599999999999999682793421535957075817597
    (-38).
Definition at_number (n : numeral) : end_of_window :=
  match end_at_number n with Some e => e | None => Dyadic 0 0 end.
Definition two_windows (last : Z) : certificate := Certificate [[
  WrittenPiece 0 (at_number (Decimal (-999846910161925) (-16))) (Some (at_number (Decimal 34203543907686442 (-16))))
    [[1; 0]; [5; 1]];
  WrittenPiece 1 (at_number (Decimal 3420354390768644 (-15))) (Some (at_number (Decimal last (-15))))
    [[1; 0]; [46; 1]]]] [[]].

Example flight_hits : correct square flight hit.
Proof. apply (accepts_ok _ _ _ (two_windows 26099984691016193) 1000). vm_compute. reflexivity. Qed.
Example window_too_short : accepts square flight hit (two_windows 26099984691016190) 1000 = false.
Proof. vm_compute. reflexivity. Qed.
