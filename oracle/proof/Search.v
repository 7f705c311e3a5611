(* docs/certificates.md, "Bounding the k": all obstacles of a window that the line meets are among those
   looked at. *)
From Coq Require Import ZArith Lia List Psatz.
From Lorentz Require Import Vectors Steps.
Import ListNotations.
Local Open Scope Z_scope.

(* ---- Ranges of k: low <= start + k step <= high. *)
Record bound := Bound { low : Z; high : Z; start : Z; step : Z }.
Definition satisfies (b : bound) (k : Z) := low b <= start b + k * step b <= high b.

Definition range (b : bound) : option (Z * Z) :=
  match step b with
  | 0 => None
  | Zpos _ => Some (- ((start b - low b) / step b), (high b - start b) / step b)
  | Zneg _ => Some (- ((high b - start b) / - step b), (start b - low b) / - step b)
  end.

(* What satisfies all bounds that have a step; nothing, if none has. *)
Fixpoint common (bounds : list bound) : option (Z * Z) :=
  match bounds with
  | [] => None
  | b :: rest => match range b, common rest with
    | Some (f, l), Some (f', l') => Some (Z.max f f', Z.min l l')
    | Some r, None => Some r
    | None, r => r
    end
  end.

Lemma range_ok b k r : satisfies b k -> range b = Some r -> fst r <= k <= snd r.
Proof.
  destruct b as [lo hi st d], r as [f l]; unfold satisfies, range; cbn [low high start step fst snd].
  destruct d as [|d|d]; intros Hs E; inversion E; clear E; subst.
  - split; [apply Z.opp_le_mono; rewrite Z.opp_involutive|]; apply Z.div_le_lower_bound; lia.
  - set (d' := - Z.neg d) in *. assert (0 < d') by lia. assert (Z.neg d = - d') by lia.
    split; [apply Z.opp_le_mono; rewrite Z.opp_involutive|]; apply Z.div_le_lower_bound; nia.
Qed.

Lemma common_ok bounds k : Forall (fun b => satisfies b k) bounds ->
  forall r, common bounds = Some r -> fst r <= k <= snd r.
Proof.
  induction 1 as [|b rest Hb _ IH]; simpl; intros r E; [discriminate|].
  destruct (range b) as [[f1 l1]|] eqn:R1; [|auto].
  pose proof (range_ok _ _ _ Hb R1) as K. destruct (common rest) as [[f2 l2]|]; inversion E; subst;
    [|exact K].
  specialize (IH _ eq_refl). cbn [fst snd] in *. lia.
Qed.

Lemma abs_sqrt x room : x * x <= room -> - Z.sqrt room <= x <= Z.sqrt room.
Proof.
  intros H. assert (Z.abs x <= Z.sqrt room); [|lia].
  assert (E : Z.abs x * Z.abs x = x * x) by (destruct (Z.abs_spec x) as [[_ ->]|[_ ->]]; ring).
  apply Z.sqrt_le_square; [lia| |lia]. nia.
Qed.

Lemma between lo hi s m : lo <= s <= hi -> Z.min (lo * m) (hi * m) <= s * m <= Z.max (lo * m) (hi * m).
Proof.
  intros. destruct (Z_le_gt_dec 0 m).
  - assert (lo * m <= s * m <= hi * m) by (split; apply Z.mul_le_mono_nonneg_r; lia). lia.
  - assert (hi * m <= s * m <= lo * m) by (split; apply Z.mul_le_mono_nonpos_r; lia). lia.
Qed.

(* ---- The algebra: s = v.w, Q = v^2, h = v x w. *)
Definition h2 (v w : zv) := dot v v * dot w w - dot v w * dot v w.

Lemma lagrange v w : h2 v w = dot (cross v w) (cross v w).
Proof. unfold h2. vectors. ring. Qed.
Lemma h2_nonneg v w : 0 <= h2 v w.
Proof. rewrite lagrange. apply square. Qed.

(* "|v^2 N.w - s (N.v)| < r |v| |N x v|": here for any vector a instead of N, and with |h| instead of r |v|. *)
Lemma across a v w :
  (dot v v * dot a w - dot v w * dot a v) * (dot v v * dot a w - dot v w * dot a v)
    <= dot (cross v a) (cross v a) * h2 v w.
Proof.
  assert (dot v v * dot a w - dot v w * dot a v = dot (cross v a) (cross v w)) as -> by (vectors; ring).
  rewrite lagrange. apply cauchy.
Qed.

(* "v^2 (e.w)^2 + (s (N.v) - v^2 L)^2 = |e|^2 |h|^2", e = v x N, L = N.w. *)
Lemma plane N v w :
  dot v v * (dot (cross v N) w * dot (cross v N) w)
    + (dot v w * dot N v - dot v v * dot N w) * (dot v w * dot N v - dot v v * dot N w)
  = dot (cross v N) (cross v N) * h2 v w.
Proof. rewrite lagrange. vectors. ring. Qed.

(* What is linear in k. *)
Lemma dot_normal b1 b2 w3 k1 k2 : dot (cross b1 b2) (add (add w3 k2 b2) k1 b1) = dot (cross b1 b2) w3.
Proof. vectors. ring. Qed.
Lemma dot_left b1 y w k2 b2 k1 :
  dot (cross b1 y) (add (add w k2 b2) k1 b1) = dot (cross b1 y) w + k2 * dot (cross b1 y) b2.
Proof. vectors. ring. Qed.
Lemma dot_right b1 y w k2 b2 k1 :
  dot (cross y b1) (add (add w k2 b2) k1 b1) = dot (cross y b1) w + k2 * dot (cross y b1) b2.
Proof. vectors. ring. Qed.
Lemma e_across v N : dot (cross v N) v = 0.
Proof. vectors. ring. Qed.
(* Cramer's rule: a = b_1 x (v x e) = (e.b_1) v - s_1 e. *)
Lemma cramer v b1 e w : dot e v = 0 ->
  dot v v * dot (cross b1 (cross v e)) w - dot v w * dot (cross b1 (cross v e)) v =
    - dot v v * dot v b1 * dot e w.
Proof.
  intros E. assert (forall y, dot (cross b1 (cross v e)) y = dot e b1 * dot v y - dot v b1 * dot e y) as F
    by (intros; clear; vectors; ring).
  rewrite !F, E. ring.
Qed.
Lemma cross_twice v b1 :
  dot (cross v (cross v b1)) (cross v (cross v b1)) = dot v v * dot (cross v b1) (cross v b1).
Proof. vectors. ring. Qed.
Lemma h2_add v w k b : h2 v (add w k b) =
  dot (cross v b) (cross v b) * (k * k) + 2 * dot (cross v b) (cross v w) * k + dot (cross v w) (cross v w).
Proof. rewrite lagrange. vectors. ring. Qed.

Section Search.
  (* The coordinates beyond the first `rank` are 0; a window may have no end. *)
  Variables (rank : nat) (v w : zv) (H : Z) (b1 b2 b3 : zv) (lo : Z) (upper : option Z).

  (* The bound of v^2 a.(w' + k b), where (v^2 a.w - s a.v)^2 <= room and s is in the window. *)
  Definition functional (a w' b : zv) (room s_lo s_hi : Z) : bound :=
    let av := dot a v in let r := Z.sqrt room in
    Bound (Z.min (s_lo * av) (s_hi * av) - r) (Z.max (s_lo * av) (s_hi * av) + r)
      (dot v v * dot a w') (dot v v * dot a b).

  Lemma functional_ok a w' b room s_lo s_hi W k : dot a W = dot a w' + k * dot a b -> s_lo <= dot v W <= s_hi ->
    (dot v v * dot a W - dot v W * dot a v) * (dot v v * dot a W - dot v W * dot a v) <= room ->
    satisfies (functional a w' b room s_lo s_hi) k.
  Proof.
    intros E Hs Hr. apply abs_sqrt in Hr. unfold satisfies, functional; cbn [low high start step].
    replace (dot v v * dot a w' + k * (dot v v * dot a b)) with (dot v v * dot a W) by (rewrite E; ring).
    pose proof (between s_lo s_hi (dot v W) (dot a v) Hs). lia.
  Qed.

  (* What a window that ends bounds besides. *)
  Definition in_ends (bounds : Z -> list bound) : list bound :=
    match upper with Some hi => bounds hi | None => [] end.
  (* The planes k_3, in each of them the rows k_2, in each row the obstacles k_1. *)
  Definition planes : list bound :=
    let N := cross b1 b2 in let e := cross v N in in_ends (fun hi => [functional N w b3 (dot e e * H) lo hi]).
  Definition off (w3 : zv) (hi : Z) : Z :=  (* how far v^2 L is from all s (N.v) of the window *)
    let N := cross b1 b2 in let Nv := dot N v in let Nw := dot v v * dot N w3 in
    Z.max 0 (Z.max (Z.min (lo * Nv) (hi * Nv) - Nw) (Nw - Z.max (lo * Nv) (hi * Nv))).
  Definition rows (w3 : zv) : list bound :=
    let N := cross b1 b2 in let e := cross v N in let s1 := dot v b1 in let h1 := cross v b1 in
    let Q := dot v v in
    functional h1 w3 b2 (Q * dot h1 h1 * H) 0 0 :: in_ends (fun hi =>
      let o := off w3 hi in
      [functional (cross b1 (cross v e)) w3 b2 (s1 * s1 * Q * (dot e e * H - o * o)) lo hi]).
  Definition obstacles (w2 : zv) : list bound :=
    let h1 := cross v b1 in let h := cross v w2 in let f := dot h1 h in
    let root := Z.sqrt (f * f - dot h1 h1 * (dot h h - H)) in
    let roots := Bound (- root) root f (dot h1 h1) in let s := dot v w2 in let s1 := dot v b1 in
    match upper, range roots with
    | Some hi, _ => [roots; Bound lo hi s s1]
    | None, Some (first, last) => [roots; Bound lo (Z.max (s + first * s1) (s + last * s1)) s s1]
    | None, None => []
    end.
  Definition ranging (i : nat) (bounds : list bound) : option (Z * Z) :=
    if (i <=? rank)%nat then common bounds else Some (0, 0).

  Definition search (judge : zv -> zv -> check) : check :=
    let? r3 := ranging 3 planes else TooMany in each r3 (fun k3 => let w3 := add w k3 b3 in
    let? r2 := ranging 2 (rows w3) else TooMany in each r2 (fun k2 => let w2 := add w3 k2 b2 in
    let? r1 := ranging 1 (obstacles w2) else TooMany in
    each r1 (fun k1 => judge (V k1 k2 k3) (add w2 k1 b1)))).

  (* Each of three lemmas: where W is in the window, and the line meets it, its k is within the bounds. *)
  Section Within.
    Variables (n : zv).
    Let w3 := add w (vz n) b3.
    Let w2 := add w3 (vy n) b2.
    Let W := add w2 (vx n) b1.
    Definition in_window (s : Z) : Prop := lo <= s /\ match upper with Some hi => s <= hi | None => True end.
    Hypothesis s_in_window : in_window (dot v W).
    Hypothesis met : h2 v W <= H.

    Lemma in_ends_ok bounds k : (forall hi, lo <= dot v W <= hi ->
      Forall (fun b => satisfies b k) (bounds hi)) -> Forall (fun b => satisfies b k) (in_ends bounds).
    Proof.
      intros K. pose proof s_in_window as S. unfold in_window, in_ends in *.
      destruct upper as [hi|]; [apply K, S|constructor].
    Qed.

    Lemma planes_ok : Forall (fun b => satisfies b (vz n)) planes.
    Proof.
      apply in_ends_ok. intros hi Hs. constructor; [|constructor]. apply functional_ok with W; auto.
      - unfold W, w2. rewrite dot_normal. apply dot_add.
      - eapply Z.le_trans; [apply across|]. apply Z.mul_le_mono_nonneg_l; [apply square|exact met].
    Qed.

    Lemma off_ok hi : lo <= dot v W <= hi -> off w3 hi * off w3 hi <=
      (dot v W * dot (cross b1 b2) v - dot v v * dot (cross b1 b2) W) *
        (dot v W * dot (cross b1 b2) v - dot v v * dot (cross b1 b2) W).
    Proof.
      intros Hs. assert (E : dot (cross b1 b2) W = dot (cross b1 b2) w3) by apply dot_normal. rewrite E.
      pose proof (between lo hi (dot v W) (dot (cross b1 b2) v) Hs) as B. unfold off. cbv zeta.
      set (Nw := dot v v * dot (cross b1 b2) w3) in *. set (y := dot v W * dot (cross b1 b2) v) in *.
      set (d := Z.max 0 _). assert (0 <= d <= Z.abs (y - Nw)) as [D1 D2] by (subst d; clear - B; lia).
      rewrite <- (Z.abs_square (y - Nw)). apply Z.mul_le_mono_nonneg; auto.
    Qed.

    (* The first bound is of h_1.w alone, for h_1.v = 0. *)
    Lemma beside_ok : satisfies (functional (cross v b1) w3 b2 (dot v v * dot (cross v b1) (cross v b1) * H) 0 0)
      (vy n).
    Proof.
      assert (K : (dot v v * dot (cross v b1) W) * (dot v v * dot (cross v b1) W) <=
        dot v v * dot (cross v b1) (cross v b1) * H).
      { eapply Z.le_trans; [|apply Z.mul_le_mono_nonneg_l; [apply Z.mul_nonneg_nonneg; apply square|exact met]].
        rewrite <- cross_twice. pose proof (across (cross v b1) v W) as A.
        rewrite (e_across v b1), Z.mul_0_r, Z.sub_0_r in A. exact A. }
      apply abs_sqrt in K. unfold satisfies, functional; cbn [low high start step].
      replace (dot v v * dot (cross v b1) w3 + vy n * (dot v v * dot (cross v b1) b2))
        with (dot v v * dot (cross v b1) W) by (unfold W, w2; rewrite dot_right; ring). lia.
    Qed.
    Lemma rows_ok : Forall (fun b => satisfies b (vy n)) (rows w3).
    Proof.
      constructor; [exact beside_ok|]. apply in_ends_ok. intros hi Hs. cbv zeta.
      pose proof (off_ok hi Hs) as Hoff. pose proof (plane (cross b1 b2) v W) as PL.
      pose proof (e_across v (cross b1 b2)) as ev. set (e := cross v (cross b1 b2)) in *.
      constructor; [|constructor]. apply functional_ok with W; auto.
      - apply dot_left.
      - rewrite cramer by auto.
        replace (- dot v v * dot v b1 * dot e W * (- dot v v * dot v b1 * dot e W))
          with (dot v b1 * dot v b1 * dot v v * (dot v v * (dot e W * dot e W))) by ring.
        apply Z.mul_le_mono_nonneg_l; [apply Z.mul_nonneg_nonneg; [apply Z.square_nonneg|apply square]|].
        assert (dot e e * h2 v W <= dot e e * H) by (apply Z.mul_le_mono_nonneg_l; [apply square|exact met]).
        clear - PL Hoff H0. lia.
    Qed.

    Lemma obstacles_ok : Forall (fun b => satisfies b (vx n)) (obstacles w2).
    Proof.
      pose proof s_in_window as [Hlo Hhi]. unfold W in Hlo, Hhi. rewrite dot_add in Hlo, Hhi.
      unfold obstacles. cbv zeta. set (roots := Bound _ _ (dot (cross v b1) (cross v w2)) _).
      assert (R : satisfies roots (vx n)).
      { unfold satisfies, roots; cbn [low high start step]. apply abs_sqrt. pose proof met as HH. unfold W in HH. rewrite h2_add in HH.
        pose proof (square (cross v b1)) as P. clear - HH P.
        set (f := dot (cross v b1) (cross v w2)) in *. set (hh1 := dot (cross v b1) (cross v b1)) in *.
        set (g0 := dot (cross v w2) (cross v w2)) in *. set (k := vx n) in *.
        assert (hh1 * (hh1 * (k * k) + 2 * f * k + g0 - H) <= 0) by (apply Z.mul_nonneg_nonpos; lia). lia. }
      destruct upper as [hi|]; [|destruct (range roots) as [[first last]|] eqn:E; [|constructor]];
        (constructor; [exact R|constructor; [|constructor]]); unfold satisfies; cbn [low high start step].
      - lia.
      - pose proof (range_ok _ _ _ R E) as K. cbn [fst snd] in K. split; [exact Hlo|]. clear - K.
        destruct (Z_le_gt_dec 0 (dot v b1)); nia.
    Qed.
  End Within.

  Lemma ranging_ok i bounds k r : Forall (fun b => satisfies b k) bounds -> ((rank < i)%nat -> k = 0) ->
    ranging i bounds = Some r -> fst r <= k <= snd r.
  Proof.
    unfold ranging. intros F Z0 E. destruct (Nat.leb_spec i rank); [exact (common_ok _ _ F _ E)|].
    injection E as <-. cbn. lia.
  Qed.

  (* The window lemma. *)
  Theorem search_ok judge : passes (search judge) ->
    forall n, fits rank n -> let W := place w n b1 b2 b3 in in_window (dot v W) -> h2 v W <= H ->
      passes (judge n W).
  Proof.
    intros Hp n (F3 & F2 & F1) W Hs HH. unfold search in Hp. subst W. destruct n as [k1 k2 k3].
    unfold place in *; cbn [vx vy vz] in *.
    pose proof (planes_ok (V k1 k2 k3) Hs HH) as P3. pose proof (rows_ok (V k1 k2 k3) Hs HH) as P2.
    pose proof (obstacles_ok (V k1 k2 k3) Hs HH) as P1. cbn [vx vy vz] in *.
    destruct (ranging 3 planes) as [r3|] eqn:C3; [|apply passes_fail in Hp; tauto].
    apply each_ok with (k := k3) in Hp; [|apply ranging_ok with (1 := P3) (3 := C3); intros; apply F3; lia].
    cbv zeta in Hp. destruct (ranging 2 (rows _)) as [r2|] eqn:C2; [|apply passes_fail in Hp; tauto].
    apply each_ok with (k := k2) in Hp; [|apply ranging_ok with (1 := P2) (3 := C2); intros; apply F2; lia].
    cbv zeta in Hp. destruct (ranging 1 (obstacles _)) as [r1|] eqn:C1; [|apply passes_fail in Hp; tauto].
    apply each_ok with (k := k1) in Hp; [exact Hp|].
    apply ranging_ok with (1 := P1) (3 := C1). intros. apply F1. lia.
  Qed.
End Search.
