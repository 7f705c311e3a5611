(* What a decision makes of such bounds: is_below of predicates.hpp, which asks whether |H| < L, from h and limit,
   which stand for them. kRho covers what the width errs by (3.501: width_in_space, made/Formulas.v) and
   the roundings of the decision. *)
From Coq Require Import Reals Lra Psatz.
From Flocq Require Import Core.
From Lorentz.bounds Require Import Errors.
From Lorentz.bounds.made Require Import Formulas.
Local Open Scope R_scope.

(* What is computed of error + kRho u limit is not less than that by more than its two roundings. *)
Lemma spread_is_enough error limit :
  number error -> 0 <= error -> 0 <= limit -> safe (kRho * u * limit) ->
  error * (1 - u) + kRho * u * limit * (1 - 2 * u) <= rnd (error + rnd (kRho * u * limit)).
Proof.
  intros F E P S. pose proof (rnd_safe _ S) as A. pose proof (rnd_sum error (rnd (kRho * u * limit)) F (number_rnd _)) as B.
  unfold errs in A, B. assert (0 <= kRho * u * limit) by (unfold u, kRho; nra).
  rewrite (Rabs_pos_eq (kRho * u * limit)) in A by assumption.
  apply Rabs_le_inv in A. assert (kRho * u * limit * (1 - u) <= rnd (kRho * u * limit)) by lra.
  assert (0 <= rnd (kRho * u * limit)) by (unfold u, kRho in *; nra).
  rewrite (Rabs_pos_eq (error + _)) in B by lra. apply Rabs_le_inv in B. unfold u, kRho in *. nra.
Qed.

Section Is_below.
  Variables h H limit L error : R.
  Hypotheses (number_limit : number limit) (number_error : number error) (some_error : 0 <= error) (some_limit : 0 < L).
  (* The bound was evaluated with roundings, too. *)
  Hypothesis height : Rabs (h - H) <= error * (1 - 2 * u).
  Hypothesis width : rounded limit L 3.501.
  Hypothesis no_underflow : safe (kRho * u * limit).
  Let spread := rnd (error + rnd (kRho * u * limit)).

  Lemma limit_is_near : (1 - 3.501 * u) * L <= limit <= (1 + 3.501 * u) * L.
  Proof. destruct width as [_ E]. rewrite (Rabs_pos_eq L) in E by lra. apply Rabs_le_inv in E. lra. Qed.

  Theorem yes_is_right : rnd (Rabs h + spread) < limit -> Rabs H < L.
  Proof.
    intros Y. apply below in Y; [|exact number_limit]. pose proof limit_is_near.
    pose proof (spread_is_enough error limit number_error some_error ltac:(unfold u, kRho in *; nra) no_underflow) as S. fold spread in S.
    pose proof (Rabs_triang_inv H h) as T. rewrite (Rabs_minus_sym H h) in T. unfold u, kRho in *. nra.
  Qed.

  Theorem no_is_right : limit < rnd (Rabs h - spread) -> L < Rabs H.
  Proof.
    intros N. apply above in N; [|exact number_limit]. pose proof limit_is_near.
    pose proof (spread_is_enough error limit number_error some_error ltac:(unfold u, kRho in *; nra) no_underflow) as S. fold spread in S.
    pose proof (Rabs_triang_inv h H) as T. unfold u, kRho in *. nra.
  Qed.
End Is_below.
