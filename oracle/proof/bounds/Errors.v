(* How errors grow along a formula. `near x X S f`: x was computed, X is what is meant; the sizes of the terms of X
   add up to S at most, and x errs by f - 1 of that. Each rule below is one operation; `bound` at the end goes
   through a formula by them. *)
From Coq Require Import ZArith Reals Lra Psatz.
From Flocq Require Import Core Plus_error Relative.
Local Open Scope R_scope.

(* ---- binary64 ------------------------------------------------------------------------------------------ *)

Definition u : R := / 9007199254740992.  (* 2^-53 *)
Definition rnd (x : R) : R := round radix2 (FLT_exp (-1074) 53) ZnearestE x.
Definition number (x : R) : Prop := generic_format radix2 (FLT_exp (-1074) 53) x.
(* What does not underflow. *)
Definition safe (x : R) : Prop := x = 0 \/ bpow radix2 (-1022) <= Rabs x.
(* x is X, but for k roundoffs. *)
Definition rounded (x X k : R) : Prop := number x /\ Rabs (x - X) <= k * u * Rabs X.
(* x is X, but for k roundoffs of S. *)
Definition rounded_of (x X S k : R) : Prop := number x /\ Rabs (x - X) <= k * u * S /\ Rabs X <= S.

Local Instance precision : Prec_gt_0 53.
Proof. reflexivity. Qed.

Lemma number_rnd x : number (rnd x).
Proof. apply generic_format_round; auto with typeclass_instances. Qed.
Lemma number_opposite x : number x -> number (- x).
Proof. apply generic_format_opp. Qed.
Lemma number_0 : number 0.
Proof. apply generic_format_0. Qed.
Lemma number_1 : number 1.
Proof. change 1 with (bpow radix2 0). apply generic_format_FLT_bpow; [reflexivity|lia]. Qed.

(* What one operation errs by: nothing else is known of it. *)
Definition errs (z exact w : R) : Prop := Rabs (z - exact) <= w * Rabs exact.
(* Operations on double-double, of which lemma 2 of docs/bounds.md says what they err by. *)
Definition adds (f : R -> R -> R) w : Prop := forall x y, errs (f x y) (x + y) w.
Definition multiplies (f : R -> R -> R) w : Prop := forall x y, errs (f x y) (x * y) w.
Definition divides (f : R -> R -> R) w : Prop := forall x y, errs (f x y) (x / y) w.

Lemma rnd_safe x : safe x -> errs (rnd x) x u.
Proof.
  intros [->|S]; unfold errs.
  - unfold rnd. rewrite round_0 by auto with typeclass_instances. rewrite Rminus_0_r, Rabs_R0. lra.
  - pose proof (relative_error_N_FLT radix2 (-1074) 53 eq_refl (fun n => negb (Z.even n)) x S) as E.
    eapply Rle_trans; [exact E|]. apply Req_le. f_equal. unfold u. cbn. lra.
Qed.
Lemma rnd_sum x y : number x -> number y -> errs (rnd (x + y)) (x + y) u.
Proof.
  intros A B. unfold errs.
  destruct (FLT_plus_error_N_ex radix2 (-1074) 53 (fun n => negb (Z.even n)) x y A B) as [e [E K]].
  unfold rnd. fold ZnearestE in K. rewrite K.
  replace ((x + y) * (1 + e) - (x + y)) with (e * (x + y)) by ring. rewrite Rabs_mult.
  apply Rmult_le_compat_r; [apply Rabs_pos|]. eapply Rle_trans; [exact E|].
  unfold u_ro, u. cbn. lra.
Qed.
Lemma rnd_difference x y : number x -> number y -> errs (rnd (x - y)) (x - y) u.
Proof. intros. apply rnd_sum; [assumption|apply number_opposite; assumption]. Qed.
(* A root does not underflow. *)
Lemma rnd_root x : number x -> errs (rnd (sqrt x)) (sqrt x) u.
Proof.
  intros F. apply rnd_safe. destruct (Rle_or_lt x 0) as [N|P].
  - left. apply sqrt_neg_0. exact N.
  - right. rewrite Rabs_pos_eq by apply sqrt_pos.
    apply Rle_trans with (sqrt (bpow radix2 (-1074))).
    + apply Rsqr_incr_0_var; [|apply sqrt_pos]. rewrite Rsqr_sqrt by apply bpow_ge_0.
      unfold Rsqr. rewrite <- bpow_plus. apply bpow_le. lia.
    + apply sqrt_le_1_alt. refine (generic_format_ge_bpow radix2 (FLT_exp (-1074) 53) _ _ x P F).
      intros. unfold FLT_exp. lia.
Qed.

(* A comparison of a result with a number does not see the last rounding. *)
Lemma below x t : number t -> rnd x < t -> x < t.
Proof.
  intros F L. apply Rnot_le_lt. intros N. apply (Rlt_irrefl t). eapply Rle_lt_trans; [|exact L].
  rewrite <- (round_generic radix2 (FLT_exp (-1074) 53) ZnearestE t F) at 1.
  apply round_le; auto with typeclass_instances.
Qed.
Lemma above x t : number t -> t < rnd x -> t < x.
Proof.
  intros F L. apply Rnot_le_lt. intros N. apply (Rlt_irrefl t). eapply Rlt_le_trans; [exact L|].
  rewrite <- (round_generic radix2 (FLT_exp (-1074) 53) ZnearestE t F) at 1.
  apply round_le; auto with typeclass_instances.
Qed.

(* ---- One rule an operation ----------------------------------------------------------------------------- *)

Definition near (x X S f : R) : Prop := Rabs (x - X) <= (f - 1) * S /\ Rabs X <= S.
Definition larger (f g h : R) : Prop := f <= h /\ g <= h.

Lemma larger_first f g : g <= f -> larger f g f.
Proof. split; lra. Qed.
Lemma larger_second f g : f <= g -> larger f g g.
Proof. split; lra. Qed.
Lemma near_exact x : near x x (Rabs x) 1.
Proof. split; [rewrite Rminus_diag_eq, Rabs_R0|]; lra. Qed.
Lemma near_rounded x X k : rounded x X k -> near x X (Rabs X) (1 + k * u).
Proof. intros [_ E]. split; [|lra]. eapply Rle_trans; [exact E|]. lra. Qed.

Lemma near_rounded_of x X S k : rounded_of x X S k -> near x X S (1 + k * u).
Proof. intros [_ [E L]]. split; [|exact L]. eapply Rle_trans; [exact E|]. lra. Qed.

Lemma near_size x X S f : near x X S f -> Rabs x <= f * S.
Proof. intros [A B]. pose proof (Rabs_triang (x - X) X) as T. replace (x - X + X) with x in T by ring. lra. Qed.
Lemma near_opposite x X S f : near x X S f -> near (- x) (- X) S f.
Proof. intros [A B]. split; [replace (- x - - X) with (- (x - X)) by ring|]; rewrite Rabs_Ropp; assumption. Qed.

(* An operation of which all is known without its own error. *)
Lemma near_step z x X S f w : errs z x w -> 0 <= w -> near x X S f -> near z X S (f * (1 + w)).
Proof.
  intros E W N. pose proof (near_size _ _ _ _ N). destruct N as [A B]. split; [|exact B].
  pose proof (Rabs_triang (z - x) (x - X)) as T. replace (z - x + (x - X)) with (z - X) in T by ring.
  unfold errs in E. nra.
Qed.

Lemma exact_sum x y X Y S T f g h : near x X S f -> near y Y T g -> larger f g h -> near (x + y) (X + Y) (S + T) h.
Proof.
  intros [A B] [C D] [F G]. pose proof (Rabs_pos X). pose proof (Rabs_pos Y).
  split; [|eapply Rle_trans; [apply Rabs_triang|lra]].
  replace (x + y - (X + Y)) with ((x - X) + (y - Y)) by ring.
  eapply Rle_trans; [apply Rabs_triang|]. nra.
Qed.
Lemma exact_difference x y X Y S T f g h :
  near x X S f -> near y Y T g -> larger f g h -> near (x - y) (X - Y) (S + T) h.
Proof. intros A B L. apply exact_sum with (1 := A) (2 := near_opposite _ _ _ _ B) (3 := L). Qed.

Lemma exact_product x y X Y S T f g : near x X S f -> near y Y T g -> near (x * y) (X * Y) (S * T) (f * g).
Proof.
  intros A B. pose proof (near_size _ _ _ _ B) as K. destruct A as [A A'], B as [B B'].
  pose proof (Rabs_pos X). pose proof (Rabs_pos Y). pose proof (Rabs_pos y).
  pose proof (Rabs_pos (x - X)). pose proof (Rabs_pos (y - Y)).
  split; [|rewrite Rabs_mult; apply Rmult_le_compat; assumption].
  replace (x * y - X * Y) with ((x - X) * y + X * (y - Y)) by ring.
  eapply Rle_trans; [apply Rabs_triang|]. rewrite !Rabs_mult.
  apply Rle_trans with ((f - 1) * S * (g * T) + S * ((g - 1) * T)); [|lra].
  apply Rplus_le_compat; apply Rmult_le_compat; lra.
Qed.

(* By what is known relatively. *)
Lemma exact_quotient x y X Y S T f g :
  near x X S f -> near y Y T g -> T = Rabs Y -> Y <> 0 -> g < 2 -> near (x / y) (X / Y) (S / Rabs Y) (f / (2 - g)).
Proof.
  intros [A A'] [B B'] -> Z G. pose proof (Rabs_pos_lt Y Z) as P.
  pose proof (Rabs_pos X). pose proof (Rabs_pos (x - X)). pose proof (Rabs_pos (y - Y)).
  assert (L : Rabs Y * (2 - g) <= Rabs y).
  { pose proof (Rabs_triang y (Y - y)) as T. replace (y + (Y - y)) with Y in T by ring.
    rewrite (Rabs_minus_sym Y y) in T. lra. }
  assert (Q : 0 < Rabs y) by nra.
  assert (y <> 0) by (intros ->; rewrite Rabs_R0 in Q; lra).
  split.
  2: { unfold Rdiv. rewrite Rabs_mult, Rabs_inv. apply Rmult_le_compat_r; [left; apply Rinv_0_lt_compat; exact P|exact A']. }
  replace (x / y - X / Y) with (((x - X) * Y + X * (Y - y)) / (y * Y)) by (field; auto).
  set (K := (f + g - 2) * S).
  assert (N : Rabs ((x - X) * Y + X * (Y - y)) <= K * Rabs Y).
  { eapply Rle_trans; [apply Rabs_triang|]. rewrite !Rabs_mult, (Rabs_minus_sym Y y). unfold K. nra. }
  assert (0 <= K) by (apply Rmult_le_reg_r with (Rabs Y); [exact P|]; pose proof (Rabs_pos ((x - X) * Y + X * (Y - y))); lra).
  unfold Rdiv at 1. rewrite Rabs_mult, Rabs_inv, Rabs_mult.
  replace ((f / (2 - g) - 1) * (S / Rabs Y)) with (K / (Rabs Y * (2 - g))) by (unfold K; field; lra).
  apply Rle_trans with (K / Rabs y).
  - apply Rle_trans with (K * Rabs Y * / (Rabs y * Rabs Y)).
    + apply Rmult_le_compat_r; [left; apply Rinv_0_lt_compat, Rmult_lt_0_compat; assumption|exact N].
    + apply Req_le. field. lra.
  - apply Rmult_le_compat_l; [assumption|]. apply Rinv_le_contravar; [nra|exact L].
Qed.

Lemma exact_root x X S f : near x X S f -> S = Rabs X -> 0 <= X -> f < 2 -> near (sqrt x) (sqrt X) (sqrt X) (2 / (3 - f)).
Proof.
  intros [A _] -> P F. rewrite (Rabs_pos_eq X P) in A. pose proof (sqrt_pos X) as Q.
  split; [|rewrite Rabs_pos_eq; lra]. destruct (Req_dec X 0) as [->|Z].
  - rewrite Rmult_0_r, Rminus_0_r in A. pose proof (Rabs_pos x). assert (x = 0) as ->.
    { destruct (Req_dec x 0) as [E|E]; [exact E|]. pose proof (Rabs_pos_lt x E). lra. }
    rewrite Rminus_diag_eq, Rabs_R0, sqrt_0 by reflexivity. lra.
  - assert (0 < X) by lra. pose proof (sqrt_lt_R0 X ltac:(assumption)) as Q'.
    pose proof (Rabs_pos (x - X)). assert (0 <= f - 1) by nra.
    assert (X * (2 - f) <= x) by (apply Rabs_le_inv in A; lra). assert (0 <= x) by nra.
    pose proof (sqrt_pos x) as R. pose proof (sqrt_sqrt x ltac:(assumption)) as E.
    pose proof (sqrt_sqrt X P) as E'.
    assert (L : (2 - f) * sqrt X <= sqrt x).
    { apply Rsqr_incr_0_var; [|exact R]. unfold Rsqr. rewrite E.
      replace ((2 - f) * sqrt X * ((2 - f) * sqrt X)) with ((2 - f) * (2 - f) * (sqrt X * sqrt X)) by ring.
      rewrite E'. nra. }
    assert (D : Rabs (sqrt x - sqrt X) * (sqrt x + sqrt X) <= (f - 1) * X).
    { rewrite <- (Rabs_pos_eq (sqrt x + sqrt X)) by lra. rewrite <- Rabs_mult.
      replace ((sqrt x - sqrt X) * (sqrt x + sqrt X)) with (x - X); [exact A|].
      rewrite <- E, <- E' at 1. ring. }
    replace (2 / (3 - f) - 1) with ((f - 1) / (3 - f)) by (field; lra).
    apply Rmult_le_reg_r with ((3 - f) * sqrt X); [nra|].
    replace ((f - 1) / (3 - f) * sqrt X * ((3 - f) * sqrt X)) with ((f - 1) * (sqrt X * sqrt X)) by (field; lra).
    rewrite E'. eapply Rle_trans; [|exact D]. apply Rmult_le_compat_l; [apply Rabs_pos|]. nra.
Qed.

(* ---- Through a formula --------------------------------------------------------------------------------- *)

Lemma conclude x X S f X' S' k w :
  near x X S f -> X = X' -> S <= S' -> f - 1 <= k * w -> 0 <= k * w -> Rabs (x - X') <= k * w * S'.
Proof.
  intros [A B] <- L F P. pose proof (Rabs_pos X).
  apply Rle_trans with (k * w * S); [eapply Rle_trans; [exact A|apply Rmult_le_compat_r; lra]|].
  apply Rmult_le_compat_l; assumption.
Qed.

Lemma sized_sum X Y S T : 0 <= X -> 0 <= Y -> S = Rabs X -> T = Rabs Y -> S + T = Rabs (X + Y).
Proof. intros A B -> ->. rewrite !Rabs_pos_eq by lra. reflexivity. Qed.
Lemma sized_product X Y S T : S = Rabs X -> T = Rabs Y -> S * T = Rabs (X * Y).
Proof. intros -> ->. symmetry. apply Rabs_mult. Qed.
Lemma sized_quotient X Y S : S = Rabs X -> S / Rabs Y = Rabs (X / Y).
Proof. intros ->. unfold Rdiv. rewrite Rabs_mult, Rabs_inv. reflexivity. Qed.
Lemma sized_root X : sqrt X = Rabs (sqrt X).
Proof. symmetry. apply Rabs_pos_eq, sqrt_pos. Qed.

Lemma absolute_square x : Rabs x * Rabs x = x * x.
Proof. rewrite <- Rabs_mult. apply Rabs_pos_eq, Rle_0_sqr. Qed.
Lemma not_zero x : 0 < x -> x <> 0.
Proof. lra. Qed.

Ltac figure := unfold u; lra.
Ltac number :=
  lazymatch goal with
  | |- number (rnd _) => apply number_rnd
  | |- number (- _) => apply number_opposite; number
  | |- number 0 => apply number_0
  | |- number 1 => apply number_1
  | H : rounded ?x _ _ |- number ?x => exact (proj1 H)
  | H : rounded_of ?x _ _ _ |- number ?x => exact (proj1 H)
  | H : number ?x |- number ?x => exact H
  end.
Ltac over_zero :=
  lazymatch goal with
  | H : 0 < ?x |- 0 < ?x => exact H
  | |- 0 < _ * _ => apply Rmult_lt_0_compat; over_zero
  | |- 0 < _ / _ => apply Rdiv_lt_0_compat; over_zero
  | |- 0 < sqrt _ => apply sqrt_lt_R0; over_zero
  | |- _ => lra
  end.
Ltac positive :=
  lazymatch goal with
  | H : 0 <= ?x |- 0 <= ?x => exact H
  | H : 0 < ?x |- 0 <= ?x => left; exact H
  | |- 0 <= ?x * ?x => apply Rle_0_sqr
  | |- 0 <= _ * _ => apply Rmult_le_pos; positive
  | |- 0 <= _ + _ => apply Rplus_le_le_0_compat; positive
  | |- 0 <= sqrt _ => apply sqrt_pos
  | |- 0 <= _ / _ => apply Rmult_le_pos; [positive|left; apply Rinv_0_lt_compat; over_zero]
  | |- _ => lra
  end.
Ltac other_than_zero := apply not_zero; over_zero.
(* The terms of X do not cancel. *)
Ltac sized :=
  lazymatch goal with
  | |- Rabs _ = Rabs _ => reflexivity
  | |- _ * _ = Rabs (_ * _) => apply sized_product; sized
  | |- _ + _ = Rabs (_ + _) => apply sized_sum; [positive|positive|sized|sized]
  | |- _ / Rabs _ = Rabs (_ / _) => apply sized_quotient; sized
  | |- sqrt _ = Rabs (sqrt _) => apply sized_root
  end.
Ltac larger := first [apply larger_first; figure | apply larger_second; figure].

(* From the operation that comes last to the inputs. *)
Ltac near :=
  lazymatch goal with
  | |- near (rnd (_ + _)) _ _ _ => eapply near_step; [apply rnd_sum; number|figure|near]
  | |- near (rnd (_ - _)) _ _ _ => eapply near_step; [apply rnd_difference; number|figure|near]
  | |- near (rnd (_ * _)) _ _ _ => eapply near_step; [apply rnd_safe; assumption|figure|near]
  | |- near (rnd (_ / _)) _ _ _ => eapply near_step; [apply rnd_safe; assumption|figure|near]
  | |- near (rnd (sqrt _)) _ _ _ => eapply near_step; [apply rnd_root; number|figure|near]
  | |- near (_ + _) _ _ _ => eapply exact_sum; [near|near|larger]
  | |- near (_ - _) _ _ _ => eapply exact_difference; [near|near|larger]
  | |- near (_ * _) _ _ _ => eapply exact_product; near
  | |- near (_ / _) _ _ _ => eapply exact_quotient; [near|near|sized|other_than_zero|figure]
  | |- near (sqrt _) _ _ _ => eapply exact_root; [near|sized|positive|figure]
  | |- near (- _) _ _ _ => eapply near_opposite; near
  | H : adds ?f _ |- near (?f _ _) _ _ _ => eapply near_step; [apply H|figure|near]
  | H : multiplies ?f _ |- near (?f _ _) _ _ _ => eapply near_step; [apply H|figure|near]
  | H : divides ?f _ |- near (?f _ _) _ _ _ => eapply near_step; [apply H|figure|near]
  | H : rounded ?x _ _ |- near ?x _ _ _ => exact (near_rounded _ _ _ H)
  | H : rounded_of ?x _ _ _ |- near ?x _ _ _ => exact (near_rounded_of _ _ _ _ H)
  | |- near 0 _ _ _ => apply near_exact
  | |- near 1 _ _ _ => apply near_exact
  | |- near ?x _ _ _ => is_var x; apply near_exact
  end.

(* What is computed is near what the claim says, and the sizes are what it says. *)
Ltac same_value := first [reflexivity | ring | lra | field; repeat split; other_than_zero].
Ltac same_sizes :=
  first [apply Req_le; sized |
         unfold Rdiv; rewrite ?Rabs_mult, ?Rabs_inv, ?Rabs_R0, ?Rabs_R1;
         repeat rewrite absolute_square; first [apply Req_le; ring | lra]].
Ltac bound := intros; eapply conclude; [near|same_value|same_sizes|figure|figure].
